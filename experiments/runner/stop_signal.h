// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Treats Ctrl-C (SIGINT), SIGTERM and, unless it is ignored, SIGHUP as a
// request to stop after the current pair; a second signal ends the program at
// once.

#ifndef QUATRO_EXPERIMENTS_RUNNER_STOP_SIGNAL_H_
#define QUATRO_EXPERIMENTS_RUNNER_STOP_SIGNAL_H_

namespace quatro {

// Applies until the program ends; for use in programs, not libraries.
void ListenForStop();

bool WasAskedToStop();

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_STOP_SIGNAL_H_
