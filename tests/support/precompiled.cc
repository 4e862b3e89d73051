// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Holds nothing: the precompiled headers of the tests need a target.
