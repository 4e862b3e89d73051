// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/published_figures.h"

#include <cstddef>

namespace quatro {

std::vector<PublishedRate> PublishedTableOne() {
  constexpr const char* kSets[] = {"00", "02", "05", "06", "07", "08"};
  constexpr struct {
    const char* method;
    double percent[6];
  } kRows[] = {
      {"FGR", {43.81, 31.45, 51.37, 56.46, 44.49, 15.78}},
      {"TEASER++", {98.62, 98.87, 98.67, 97.93, 97.90, 98.63}},
      {"Quatro", {99.30, 99.24, 99.63, 99.34, 99.75, 98.86}},
  };
  std::vector<PublishedRate> rates;
  for (const auto& row : kRows) {
    for (std::size_t i = 0; i < std::size(kSets); ++i) {
      rates.push_back({row.method, kSets[i], row.percent[i]});
    }
  }
  return rates;
}

std::vector<PublishedDrift> PublishedTableTwo() {
  return {
      {"ICP", 1, 6.88, 2.99},           {"ICP", 3, 21.92, 8.70},
      {"ICP", 5, 21.14, 8.51},          {"G-ICP", 1, 1.26, 0.45},
      {"G-ICP", 3, 5.50, 1.45},         {"G-ICP", 5, 14.20, 3.32},
      {"VG-ICP", 1, 1.03, 0.30},        {"VG-ICP", 3, 11.83, 1.65},
      {"VG-ICP", 5, 19.11, 6.32},       {"FGR", 1, 2.73, 0.69},
      {"FGR", 3, 7.17, 1.58},           {"FGR", 5, 14.66, 4.12},
      {"TEASER++", 1, 2.11, 0.91},      {"TEASER++", 3, 2.64, 1.11},
      {"TEASER++", 5, 3.19, 0.91},      {"Quatro", 1, 1.45, 0.41},
      {"Quatro", 3, 1.38, 0.24},        {"Quatro", 5, 1.94, 0.46},
      {"SUMA", 1, 0.68, 0.23},          {"SUMA", 3, 1.69, 0.61},
      {"SUMA", 5, 2.36, 0.51},          {"A-LOAM", 1, 0.70, 0.27},
      {"A-LOAM", 3, 0.97, 0.38},        {"A-LOAM", 5, 31.16, 12.10},
      {"LO-Net", 1, 1.47, 0.72},        {"LO-Net+M", 1, 0.78, 0.42},
      {"DMLO", 1, 0.83, 0.44},          {"DMLO+M", 1, 0.73, 0.44},
      {"StickyPillars", 1, 0.65, 0.26}, {"StickyPillars", 3, 0.79, 0.31},
      {"StickyPillars", 5, 1.29, 0.48}, {"Quatro-c2f", 1, 0.65, 0.21},
      {"Quatro-c2f", 3, 0.67, 0.21},    {"Quatro-c2f", 5, 0.67, 0.21},
  };
}

std::vector<PublishedErrors> PublishedTableThree() {
  return {
      {"RANSAC10K", "0-2 m", 2.369, 14.22},
      {"RANSAC10K", "4-6 m", 5.010, 27.35},
      {"RANSAC10K", "8-10 m", 8.341, 33.34},
      {"FGR", "0-2 m", 0.057, 0.222},
      {"FGR", "4-6 m", 0.103, 0.301},
      {"FGR", "8-10 m", 1.821, 1.828},
      {"TEASER++", "0-2 m", 0.070, 0.285},
      {"TEASER++", "4-6 m", 0.131, 0.481},
      {"TEASER++", "8-10 m", 0.498, 1.469},
      {"Quatro", "0-2 m", 0.067, 0.324},
      {"Quatro", "4-6 m", 0.120, 0.465},
      {"Quatro", "8-10 m", 0.471, 0.724},
      {"Quatro w/ INS", "0-2 m", 0.059, 0.207},
      {"Quatro w/ INS", "4-6 m", 0.101, 0.230},
      {"Quatro w/ INS", "8-10 m", 0.429, 0.346},
  };
}

std::vector<PublishedRate> PublishedKittiLc() {
  constexpr const char* kSets[] = {"0-10 m", "10-20 m", "20-30 m"};
  constexpr struct {
    const char* method;
    double all;
    double percent[3];  // Negative if it was not published.
  } kRows[] = {
      {"FPFH+RANSAC", 71.4, {98.7, 80.8, 42.9}},
      {"FPFH+TEASER++", 74.4, {99.0, 84.9, 47.0}},
      {"FPFH+Quatro", 79.7, {99.3, 90.2, 55.8}},
      {"KISS-Matcher", 52.1, {-1.0, -1.0, -1.0}},
      {"PAGOR", 83.1, {100.0, 93.8, 61.1}},
      {"PARTE", 85.8, {-1.0, -1.0, -1.0}},
      {"G3Reg", 86.5, {98.6, 93.1, 71.8}},
  };
  std::vector<PublishedRate> rates;
  for (const auto& row : kRows) {
    rates.push_back({row.method, "all", row.all});
    for (std::size_t i = 0; i < 3; ++i) {
      if (row.percent[i] < 0.0) continue;
      rates.push_back({row.method, kSets[i], row.percent[i]});
    }
  }
  return rates;
}

}  // namespace quatro
