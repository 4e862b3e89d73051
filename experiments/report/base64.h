// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Encodes bytes as text by RFC 4648, section 4.

#ifndef QUATRO_EXPERIMENTS_REPORT_BASE64_H_
#define QUATRO_EXPERIMENTS_REPORT_BASE64_H_

#include <string>
#include <string_view>

namespace quatro {

std::string EncodeBase64(std::string_view bytes);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_BASE64_H_
