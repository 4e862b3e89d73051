// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Points as text, one on each line: .xyz, .txt and .csv.
//
//   # a comment
//   x,y,z,intensity
//   1.5,2.5,3.5,0.25
//
// Numbers are separated by blanks, commas or semicolons, the same on all lines,
// and have decimal points. Without a header x, y and z are the first three
// columns, and of four columns the last is the intensity. A header names the
// columns (FindCloudColumns); it may be a comment, as NumPy and CloudCompare
// write it, if it has as many names as there are columns. A first line of one
// number is the number of points. Empty lines are ignored, and so is the rest
// of a line after # or //.

#ifndef QUATRO_FEATURES_IO_POINT_TEXT_H_
#define QUATRO_FEATURES_IO_POINT_TEXT_H_

#include <optional>
#include <string>
#include <string_view>

#include "features/io/point_cloud.h"

namespace quatro {

// Returns nullopt and sets *error, without a path, if `bytes` contain no cloud,
// or if a line has more or fewer numbers than the first.
std::optional<PointCloud> ParsePointText(std::string_view bytes,
                                         std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_POINT_TEXT_H_
