// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/base/abi_guard.h"

namespace quatro::abi {

template <int kMaxAlignBytes, int kMaxStaticAlignBytes>
void library_compiled_with_other_EIGEN_MAX_ALIGN_BYTES_than() {}

template void library_compiled_with_other_EIGEN_MAX_ALIGN_BYTES_than<
    EIGEN_MAX_ALIGN_BYTES,
    EIGEN_MAX_STATIC_ALIGN_BYTES>();

}  // namespace quatro::abi
