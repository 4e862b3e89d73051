// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The page without data: page/ and three.js in one file, built by
// build_template.mjs together with quatro.

#ifndef QUATRO_EXPERIMENTS_REPORT_REPORT_TEMPLATE_H_
#define QUATRO_EXPERIMENTS_REPORT_REPORT_TEMPLATE_H_

#include <optional>
#include <string>
#include <string_view>

namespace quatro {

// The three marks that are replaced by data, each once and in this order.
inline constexpr std::string_view kTitleMark = "@@QUATRO_TITLE@@";
inline constexpr std::string_view kDataMark = "@@QUATRO_DATA@@";
inline constexpr std::string_view kViewsMark = "@@QUATRO_VIEWS@@";

// Returns nullopt, with *error saying what to install, if quatro was built
// without the template.
std::optional<std::string> ReadReportTemplate(std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_REPORT_TEMPLATE_H_
