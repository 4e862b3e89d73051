// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
TEST(Placeholder, None) {}
