// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/bin_layout.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "features/base/random.h"

namespace quatro {
namespace {

constexpr std::size_t kMinNumPoints = 64;
constexpr std::size_t kNumSamples = 1 << 13;
constexpr double kMaxCoordinate = 8e6;       // [m]
constexpr double kMaxShareSenseless = 0.01;  // Stray points.

// In a file of few points, stray points may have a larger share.
constexpr double kMaxShareSenselessOfFew = 0.1;

// Values have c columns only if G(c) is below this share of G(1).
constexpr double kMaxShareOfUnstructured = 0.98;

// A divisor d of c is preferred unless G(c) is below this share of G(d).
constexpr double kMaxShareOfDivisor = 0.8;

// A file as values of one type.
struct Values {
  std::string_view bytes;
  ScalarType type;

  std::size_t Size() const { return bytes.size() / SizeOf(type); }

  double At(std::size_t i) const {
    return DecodeScalar(
        bytes.data() + i * SizeOf(type), type, std::endian::little);
  }

  // Whether the value may belong to a point at the origin.
  bool IsAmongThreeZeros(std::size_t i) const {
    int num_zeros = 0;
    const std::size_t end = std::min(Size(), i + 3);
    for (std::size_t k = i < 2 ? 0 : i - 2; k < end; ++k) {
      num_zeros = At(k) == 0.0 ? num_zeros + 1 : 0;
      if (num_zeros == 3) return true;
    }
    return false;
  }
};

// asinh of a value, and its index.
struct Sample {
  double g;
  std::size_t index;
};

// Samples sorted by g. The indices are random, because even steps would favor
// some columns.
std::vector<Sample> DrawSamples(const Values& values) {
  Random random(1);
  std::vector<Sample> samples;
  const std::size_t num_values = values.Size();
  const std::size_t num_draws = std::min(num_values, kNumSamples);
  for (std::size_t i = 0; i < num_draws; ++i) {
    const std::size_t index =
        num_draws == num_values ? i : random.Below(num_values);
    const double value = values.At(index);
    if (!std::isfinite(value)) continue;
    if (value == 0.0 && values.IsAmongThreeZeros(index)) continue;
    samples.push_back({std::asinh(value), index});
  }
  std::ranges::sort(samples, {}, &Sample::g);
  return samples;
}

// Equation (1) of `c` columns.
double MeanDifference(std::span<const Sample> samples, std::size_t c) {
  struct Column {
    double count = 0.0, sum = 0.0, differences = 0.0;
  };
  std::vector<Column> columns(c);
  for (const auto& [g, index] : samples) {
    Column& column = columns[index % c];
    column.differences += column.count * g - column.sum;
    column.count += 1.0;
    column.sum += g;
  }
  double total = 0.0;
  for (const Column& column : columns) {
    if (column.count > 1.0) {
      total += 2.0 * column.differences / (column.count - 1.0);
    }
  }
  return total / static_cast<double>(samples.size());
}

// The number of columns, or 0 if there are none.
int FindNumValues(std::span<const Sample> samples) {
  constexpr std::size_t kMax = 8;
  if (samples.size() < kMinNumPoints) return 0;
  std::array<double, kMax + 1> g = {};
  for (std::size_t c = 1; c <= kMax; ++c) g[c] = MeanDifference(samples, c);
  auto best =
      static_cast<std::size_t>(std::min_element(&g[3], g.end()) - g.begin());
  for (const std::size_t divisor : {std::size_t{3}, std::size_t{4}}) {
    if (best == 2 * divisor && g[best] >= kMaxShareOfDivisor * g[divisor]) {
      best = divisor;
    }
  }
  return g[best] < kMaxShareOfUnstructured * g[1] ? static_cast<int>(best) : 0;
}

// The share of samples that are too large for coordinates.
double ShareOfSenseless(std::span<const Sample> samples) {
  const double limit = std::asinh(kMaxCoordinate);
  const auto num_senseless = std::ranges::count_if(
      samples,
      [&](const Sample& sample) { return std::abs(sample.g) > limit; });
  return static_cast<double>(num_senseless) /
         std::max(1.0, static_cast<double>(samples.size()));
}

// Whether the last 29 bits of most nonzero doubles are zero, as in doubles that
// were converted from float32 or are whole numbers.
bool HasEmptyHalves(std::string_view bytes) {
  Random random(2);
  const std::size_t num_doubles = bytes.size() / sizeof(double);
  int num_nonzero = 0, num_empty = 0;
  for (std::size_t i = 0; i < kNumSamples && num_doubles > 0; ++i) {
    const std::size_t index = random.Below(num_doubles);
    const auto half_at = [&](std::size_t offset) {
      return static_cast<std::uint32_t>(
          DecodeScalar(bytes.data() + index * sizeof(double) + offset,
                       ScalarType::kUint32,
                       std::endian::little));
    };
    if (half_at(4) == 0) continue;
    ++num_nonzero;
    if ((half_at(0) & 0x1fffffffu) == 0) ++num_empty;
  }
  return num_nonzero > 0 && num_empty > 0.9 * num_nonzero;
}

bool IsDouble(std::string_view bytes, std::span<const Sample> as_float) {
  if (bytes.size() % sizeof(double) != 0) return false;
  if (ShareOfSenseless(as_float) <= kMaxShareSenseless &&
      !HasEmptyHalves(bytes)) {
    return false;
  }
  const auto as_double = DrawSamples({bytes, ScalarType::kFloat64});
  return !as_double.empty() &&
         ShareOfSenseless(as_double) <= kMaxShareSenseless;
}

std::string WrongCoordinates(double largest) {
  char text[160];
  std::snprintf(text,
                sizeof(text),
                "coordinates up to %.1e m. The file is probably not float32 x, "
                "y, z, intensity; set point_floats or convert it",
                largest);
  return text;
}

// Whether most values that are not zero are tiny, as integers are if they are
// read as float32. Of points of `num_values` values, only the coordinates
// count.
bool AreIntegers(std::span<const Sample> samples, std::size_t num_values) {
  constexpr double kTiny = 1e-30;
  std::size_t num_nonzero = 0, num_tiny = 0;
  for (const Sample& sample : samples) {
    if (sample.g == 0.0 || sample.index % num_values >= 3) continue;
    ++num_nonzero;
    if (std::abs(sample.g) < kTiny) ++num_tiny;
  }
  return 2 * num_tiny > num_nonzero;
}

// Whether a file with few points could as well be of another layout than
// float32 x y z intensity: its size divides, and its columns are more alike.
// An intensity that never changes leaves no doubt.
bool IsAmbiguous(const Values& values, std::span<const Sample> samples) {
  constexpr std::size_t kKittiValues = 4;
  const std::size_t size = values.Size();
  bool is_constant = true;
  for (std::size_t i = 3; i < size && is_constant; i += kKittiValues) {
    is_constant = values.At(i) == values.At(3);
  }
  if (is_constant || samples.empty()) return false;
  const double difference = MeanDifference(samples, kKittiValues);
  for (const std::size_t c : {3u, 5u, 6u}) {
    if (size % c == 0 && MeanDifference(samples, c) < difference) return true;
  }
  return false;
}

std::string NotWholePoints(std::size_t size, const BinLayout& layout) {
  return "size " + std::to_string(size) + " bytes is not a multiple of " +
         std::to_string(layout.PointSize()) + " (" +
         (layout.num_values == 4
              ? std::string("x y z intensity")
              : std::to_string(layout.num_values) + " numbers a point") +
         " as " +
         (layout.type == ScalarType::kFloat64 ? "float64" : "float32") +
         "); is it truncated, or of another layout (point_floats)?";
}

// If all but every k-th row of c values are zero, a point has k such rows, of
// which only the first is not zero. Returns the largest such k, or 1 if there
// are too few rows to decide.
int FindZeroColumns(const Values& values, int c) {
  const auto num_columns = static_cast<std::size_t>(c);
  const std::size_t num_rows = values.Size() / num_columns;
  std::size_t first = 0, step = 0;
  for (std::size_t row = 0; row < num_rows && step != 1; ++row) {
    bool is_zero = true;
    for (std::size_t i = 0; i < num_columns && is_zero; ++i) {
      is_zero = values.At(row * num_columns + i) == 0.0;
    }
    if (is_zero) continue;
    if (step == 0 && first == 0) first = row + 1;
    step = std::gcd(step, row + 1 - first);
  }
  const bool is_told = step > 1 && num_rows / step >= kMinNumPoints / 4;
  return is_told ? static_cast<int>(std::min(step, kMinNumPoints)) : 1;
}

// Returns nullopt and sets *error if the values have no columns, too many
// columns or no coordinates.
std::optional<int> NumValuesOf(const Values& values,
                               std::span<const Sample> samples,
                               std::string* error) {
  int num_values = FindNumValues(samples);
  if (num_values > 0) num_values *= FindZeroColumns(values, num_values);
  std::vector<Sample> coordinates;
  for (const Sample& sample : samples) {
    if (num_values == 0 ||
        sample.index % static_cast<std::size_t>(num_values) < 3) {
      coordinates.push_back(sample);
    }
  }
  if (ShareOfSenseless(coordinates) > kMaxShareSenseless) {
    *error = WrongCoordinates(std::sinh(
        std::max(std::abs(samples.front().g), std::abs(samples.back().g))));
    return std::nullopt;
  }
  if (num_values == 0) {
    *error =
        "cannot tell how many numbers a point has; if x, y, z and intensity "
        "as float32, set point_floats=4";
    return std::nullopt;
  }
  constexpr int kMaxKnown = 6;
  if (num_values > kMaxKnown) {
    *error = "a point seems to have " + std::to_string(num_values) +
             " numbers, not x, y, z, intensity; if so, set point_floats=" +
             std::to_string(num_values);
    return std::nullopt;
  }
  return num_values;
}

}  // namespace

std::optional<BinLayout> FindBinLayout(std::string_view bytes,
                                       int num_values,
                                       std::string* error) {
  BinLayout layout;
  if (num_values > 0) layout.num_values = num_values;
  const bool is_scan = bytes.size() >= kMinNumPoints * layout.PointSize();
  if (bytes.size() % sizeof(float) == 0) {
    auto samples = DrawSamples({bytes, layout.type});
    if (is_scan && IsDouble(bytes, samples)) {
      layout.type = ScalarType::kFloat64;
      if (num_values == 0) samples = DrawSamples({bytes, layout.type});
    }
    if (layout.type == ScalarType::kFloat32 &&
        AreIntegers(
            samples,
            num_values > 0 ? static_cast<std::size_t>(num_values) : 1)) {
      *error =
          "is not float32, because most numbers are below 1e-30; if they are "
          "integers, convert them to float32";
      return std::nullopt;
    }
    // Without samples there is no finite point, which ParseKittiBin() reports.
    if (is_scan && num_values == 0 && !samples.empty()) {
      const auto found = NumValuesOf({bytes, layout.type}, samples, error);
      if (!found) return std::nullopt;
      layout.num_values = *found;
    }
  }
  if (bytes.size() % layout.PointSize() != 0) {
    *error = NotWholePoints(bytes.size(), layout);
    return std::nullopt;
  }
  if (!is_scan && num_values == 0) {
    const Values values{bytes, layout.type};
    const auto samples = DrawSamples(values);
    if (ShareOfSenseless(samples) > kMaxShareSenselessOfFew) {
      *error = WrongCoordinates(std::sinh(
          std::max(std::abs(samples.front().g), std::abs(samples.back().g))));
      return std::nullopt;
    }
    if (IsAmbiguous(values, samples)) {
      *error = "has too few points to tell the layout; set point_floats";
      return std::nullopt;
    }
  }
  return layout;
}

}  // namespace quatro
