// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/option.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

namespace quatro {
namespace {

template <typename Number>
bool ParseNumber(std::string_view text, Number* number) {
  Number parsed{};
  const auto [end, code] =
      std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (code != std::errc() || end != text.data() + text.size()) return false;
  *number = parsed;
  return true;
}

bool ParseField(const std::string& text, bool* field) {
  if (text != "on" && text != "off") return false;
  *field = text == "on";
  return true;
}

template <typename Number>
bool ParseField(const std::string& text, Number* field) {
  return ParseNumber(text, field);
}

// "1,2,3"; empty if a part is no number.
std::vector<double> ParseNumbers(const std::string& text) {
  std::vector<double> numbers;
  std::string_view rest = text;
  while (true) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    if (!ParseNumber(rest.substr(0, comma), &numbers.emplace_back())) return {};
    if (comma == rest.size()) return numbers;
    rest.remove_prefix(comma + 1);
  }
}

bool ParseField(const std::string& text, Eigen::Vector3d* field) {
  const std::vector<double> numbers = ParseNumbers(text);
  if (numbers.size() != 3) return false;
  *field = {numbers[0], numbers[1], numbers[2]};
  return true;
}

bool ParseField(const std::string& text, Rigid3* field) {
  const std::vector<double> numbers = ParseNumbers(text);
  if (numbers.size() != 12 && numbers.size() != 16) return false;
  for (std::size_t i = 0; i < 12; ++i) {
    const auto row = static_cast<Eigen::Index>(i / 4);
    const auto column = static_cast<Eigen::Index>(i % 4);
    (column < 3 ? field->rotation(row, column) : field->translation[row]) =
        numbers[i];
  }
  return true;
}

bool ParseField(const std::string& text, const DegreesField& field) {
  double degrees = 0.0;
  if (!ParseNumber(text, &degrees)) return false;
  *field.radians = degrees * M_PI / 180.0;
  return true;
}

bool ParseField(const std::string& text, const AttitudeField& field) {
  Eigen::Vector3d angles;
  if (!ParseField(text, &angles)) return false;
  *field.attitude = {angles.x(), angles.y(), angles.z()};
  return true;
}

bool ParseField(const std::string& text, const Choice& choice) {
  const auto name = std::find(choice.names.begin(), choice.names.end(), text);
  if (name == choice.names.end()) return false;
  choice.set(static_cast<std::size_t>(name - choice.names.begin()));
  return true;
}

std::string NamesOf(const Choice& choice) {
  std::string names;
  for (const std::string& name : choice.names) {
    names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

// "a number", as in "must be a number".
struct WantedText {
  std::string operator()(bool*) const { return "on or off"; }
  std::string operator()(double*) const { return "a number"; }
  std::string operator()(const Choice& choice) const {
    return "one of " + NamesOf(choice);
  }
  std::string operator()(Eigen::Vector3d*) const {
    return "three numbers, x,y,z";
  }
  std::string operator()(const DegreesField&) const { return "a number"; }
  std::string operator()(Rigid3*) const { return "12 or 16 numbers"; }
  std::string operator()(const AttitudeField&) const {
    return "three numbers, roll,pitch,yaw";
  }
  template <typename Integer>
  std::string operator()(Integer*) const {
    return "an integer";
  }
};

}  // namespace

std::string Option::Describe() const {
  std::string all = range + (range.empty() ? "" : ": ") + text;
  if (const auto* choice = std::get_if<Choice>(&field)) {
    all += ": " + NamesOf(*choice);
  }
  return all;
}

bool Option::Parse(const std::string& value, std::string* error) const {
  const auto parse = [&](const auto& f) { return ParseField(value, f); };
  if (std::visit(parse, field)) return true;
  *error =
      name + " = " + value + ", must be " + std::visit(WantedText(), field);
  return false;
}

}  // namespace quatro
