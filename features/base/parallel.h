// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A loop over several threads whose result cannot depend on the number of
// threads.
//
// body(begin, end) is called on disjoint pieces of [0, n), in any order and by
// any thread. It must write only what belongs to its piece. The loop uses
// std::thread instead of a task library, because loops here run for
// milliseconds and thread sanitizers understand std::thread.
//
// An exception from body (std::bad_alloc) is rethrown on the caller's thread
// once all threads have ended. If a thread cannot be started, the loop runs
// with fewer.

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

// The number of threads to use. If `num_threads` is 0, one per core.
inline int NumThreadsToUse(int num_threads) {
  if (num_threads > 0) return num_threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Calls `body` on all pieces of [0, n); each has size `piece`, except the last.
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

// Runs both functions, at the same time if there are two threads.
template <typename First, typename Second>
void ParallelDo(int num_threads, const First& first, const Second& second) {
  ParallelFor(num_threads, 2, 1, [&](Eigen::Index begin, Eigen::Index end) {
    if (begin == 0) first();
    if (end == 2) second();
  });
}

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_PARALLEL_H_
