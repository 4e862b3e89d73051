// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A loop over several threads whose result can't depend on how many.
//
// body(begin, end) is called on disjoint pieces of [0, n), in any order and by
// any thread; it writes only what belongs to its piece. std::thread rather than
// a task library: the loops here run for milliseconds, and thread sanitizers
// understand it.
//
// What body throws (std::bad_alloc) comes out of the loop, on the caller's
// thread, once all threads have ended. A thread that can't be started is done
// without.

#ifndef QUATRO_FEATURES_BASE_PARALLEL_H_
#define QUATRO_FEATURES_BASE_PARALLEL_H_

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <exception>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace quatro {

// `num_threads` 0 stands for as many as the machine has.
inline int NumThreadsToUse(int num_threads) {
  if (num_threads > 0) return num_threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Calls `body` on all pieces of [0, n) of the given size.
template <typename Body>
void ParallelFor(int num_threads,
                 Eigen::Index n,
                 Eigen::Index piece,
                 const Body& body) {
  const Eigen::Index num_pieces = (n + piece - 1) / piece;
  const auto num_workers =
      std::min<Eigen::Index>(NumThreadsToUse(num_threads), num_pieces);
  std::atomic<Eigen::Index> next{0};
  std::atomic<bool> has_failed{false};
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (Eigen::Index i = next++; i < num_pieces && !has_failed; i = next++) {
        body(i * piece, std::min(n, (i + 1) * piece));
      }
    } catch (...) {
      if (!has_failed.exchange(true)) failure = std::current_exception();
    }
  };
  std::vector<std::thread> workers;
  try {
    for (Eigen::Index w = 1; w < num_workers; ++w) workers.emplace_back(work);
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  work();
  for (std::thread& worker : workers) worker.join();
  if (failure) std::rethrow_exception(failure);
}

// Two things at once, if there are two threads.
template <typename First, typename Second>
void ParallelDo(int num_threads, const First& first, const Second& second) {
  ParallelFor(num_threads, 2, 1, [&](Eigen::Index begin, Eigen::Index end) {
    if (begin == 0) first();
    if (end == 2) second();
  });
}

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_PARALLEL_H_
