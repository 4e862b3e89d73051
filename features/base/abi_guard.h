// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A program that aligns Eigen's types differently from the library would crash.
// This header makes it fail to link instead: each file that includes it refers
// to a function with the file's own alignment in its name, and the library
// defines the function for the library's alignment alone.

#ifndef QUATRO_FEATURES_BASE_ABI_GUARD_H_
#define QUATRO_FEATURES_BASE_ABI_GUARD_H_

#include <Eigen/Core>

namespace quatro::abi {

// If the linker finds this undefined: compile the program with the library's
// flags, without -march=native, -mavx or EIGEN_MAX_ALIGN_BYTES of its own, or
// compile the library with those of the program.
template <int kMaxAlignBytes, int kMaxStaticAlignBytes>
void library_compiled_with_other_EIGEN_MAX_ALIGN_BYTES_than();

// The reference. "used" keeps it in optimized files and under LTO, "retain"
// keeps it under --gc-sections.
#if __has_cpp_attribute(gnu::retain)
[[gnu::retain]]
#endif
[[gnu::used]] static void (*const kSameAlignment)() =
    &library_compiled_with_other_EIGEN_MAX_ALIGN_BYTES_than<
        EIGEN_MAX_ALIGN_BYTES,
        EIGEN_MAX_STATIC_ALIGN_BYTES>;

}  // namespace quatro::abi

#endif  // QUATRO_FEATURES_BASE_ABI_GUARD_H_
