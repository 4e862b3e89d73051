// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Ctrl-C (SIGINT) and SIGTERM as a wish to stop after the pair in hand; the
// second time they end the program at once.

#ifndef QUATRO_EXPERIMENTS_RUNNER_STOP_SIGNAL_H_
#define QUATRO_EXPERIMENTS_RUNNER_STOP_SIGNAL_H_

namespace quatro {

// For the rest of the program; of programs, not of libraries.
void ListenForStop();

bool WasAskedToStop();

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_STOP_SIGNAL_H_
