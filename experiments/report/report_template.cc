// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/report_template.h"

#include "experiments/base/shared_file.h"
#include "features/base/file.h"

namespace quatro {

std::optional<std::string> ReadReportTemplate(std::string* error) {
  const std::string path = FindSharedFile("report_template.html").string();
  auto text = ReadWholeFile(path, error);
  if (!text) {
    *error =
        "no report can be written because quatro was built without node and "
        "npm; "
        "install them, run third_party/install.sh, configure and build again";
    return std::nullopt;
  }
  std::size_t at = 0;
  for (const std::string_view mark : {kTitleMark, kDataMark, kViewsMark}) {
    at = text->find(mark, at);
    if (at == std::string::npos) {
      *error = path + ": does not contain " + std::string(mark) +
               "; build quatro again";
      return std::nullopt;
    }
  }
  return text;
}

}  // namespace quatro
