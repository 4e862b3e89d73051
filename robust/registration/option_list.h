// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The registry of options (robust/registration/option.h). Flags of programs,
// arguments in Python, JSON and help texts are all made from these lists.

#ifndef QUATRO_ROBUST_REGISTRATION_OPTION_LIST_H_
#define QUATRO_ROBUST_REGISTRATION_OPTION_LIST_H_

#include <vector>

#include "robust/registration/option.h"
#include "robust/registration/options.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// Options in the order of help texts.
using OptionList = std::vector<Option>;

// Appends the options of `more`.
void Append(OptionList more, OptionList* list);

// Options that all methods share: noise bound, seed, threads, probability.
OptionList CommonOptions(RegistrationOptions* options);

// Options of the stages before and after the estimator, of the INS, and of the
// bounds on the pose.
OptionList FrontEndOptionList(RegistrationOptions* options);
OptionList RefinementOptionList(RegistrationOptions* options);
OptionList SearchOptionList(RegistrationOptions* options);
OptionList InsOptionList(RegistrationOptions* options);
OptionList BoundsOptionList(RegistrationOptions* options);

// Options of the estimators. The exact yaw has no options of GNC.
OptionList QuatroOptionList(RegistrationOptions* options);
OptionList QuatroExactOptionList(RegistrationOptions* options);
OptionList ArcConsensusOptionList(RegistrationOptions* options);
OptionList ConsensusOptionList(RegistrationOptions* options);
OptionList TeaserOptionList(RegistrationOptions* options);
OptionList FgrOptionList(RegistrationOptions* options);
OptionList RansacOptionList(RegistrationOptions* options);

// Options of local alignment alone.
OptionList LocalAlignmentOptionList(LocalAlignmentOptions* options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_OPTION_LIST_H_
