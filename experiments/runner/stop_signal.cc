// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/stop_signal.h"

#include <csignal>

namespace quatro {
namespace {

volatile std::sig_atomic_t was_asked = 0;

}  // namespace

void ListenForStop() {
  struct sigaction action = {};
  action.sa_handler = [](int) { was_asked = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  // nohup ignores it.
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

bool WasAskedToStop() { return was_asked != 0; }

}  // namespace quatro
