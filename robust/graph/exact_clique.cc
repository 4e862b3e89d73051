// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/exact_clique.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <sstream>

#include "features/base/simd.h"
#include "robust/graph/max_clique.h"

namespace quatro {
namespace {

using Word = Graph::Word;

std::size_t NumWords(int num_bits) {
  return static_cast<std::size_t>((num_bits + Graph::kWordBits - 1) /
                                  Graph::kWordBits);
}

std::size_t WordOf(int i) {
  return static_cast<std::size_t>(i / Graph::kWordBits);
}

Word BitOf(int i) { return Word{1} << (i % Graph::kWordBits); }

std::vector<Word> FirstBits(int num_bits) {
  std::vector<Word> bits(NumWords(num_bits), ~Word{0});
  if (num_bits % Graph::kWordBits != 0) bits.back() = BitOf(num_bits) - 1;
  return bits;
}

// Reads the clock only once in a while.
class Deadline {
 public:
  explicit Deadline(double seconds) : seconds_(seconds) {}

  // `work` is what was done since the last call, in words of bits.
  bool IsOver(std::size_t work) {
    work_ += work;
    if (work_ < kWorkBetweenLooks || is_over_) return is_over_;
    work_ = 0;
    const std::chrono::duration<double> elapsed = Clock::now() - start_;
    is_over_ = elapsed.count() >= seconds_;
    return is_over_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kWorkBetweenLooks = 1 << 16;  // About 20 us.

  double seconds_;
  Clock::time_point start_ = Clock::now();
  std::size_t work_ = 0;
  bool is_over_ = false;
};

// A vertex to branch on. This vertex, the branches before it and the vertices
// that need no branch contain no clique of more than `bound` vertices.
struct Branch {
  int vertex = 0;
  int bound = 0;
};

// Buffers of ColorBranches(), reused to avoid allocations; no state is kept in
// them.
struct ColoringScratch {
  std::vector<Word> uncolored;
  std::vector<Word> open;      // Vertices that may still join the class.
  std::vector<Word> classes;   // The free classes, row by row.
  std::vector<char> is_spent;  // Whether a class is part of a conflict.
};

// The classes of a coloring whose vertices need no branch.
struct FreeClasses {
  const Graph& graph;
  std::size_t num_words;
  std::size_t num_classes;
  Word* classes;
  char* is_spent;
};

// Re-coloring and conflict of the header. Returns whether v needs no branch;
// also true if time is up.
QUATRO_SIMD_INLINE bool FindRoom(int v,
                                 const FreeClasses& free,
                                 Deadline* deadline) {
  const std::size_t num_words = free.num_words;
  const Word* const v_row = free.graph.Row(v).data();
  for (std::size_t a = 0; a < free.num_classes; ++a) {
    if (free.is_spent[a]) continue;
    Word* const class_a = free.classes + a * num_words;
    int num_shared = 0;
    int w = 0;
    for (std::size_t k = 0; k < num_words && num_shared < 2; ++k) {
      const Word shared = class_a[k] & v_row[k];
      if (shared == 0) continue;
      num_shared += (shared & (shared - 1)) == 0 ? 1 : 2;
      w = static_cast<int>(k) * Graph::kWordBits + std::countr_zero(shared);
    }
    if (deadline->IsOver(num_words)) return true;
    if (num_shared == 0) {
      class_a[WordOf(v)] |= BitOf(v);
      return true;
    }
    if (num_shared > 1) continue;

    const Word* const w_row = free.graph.Row(w).data();
    std::size_t conflict = free.num_classes;
    for (std::size_t b = 0; b < free.num_classes; ++b) {
      if (b == a || free.is_spent[b]) continue;
      Word* const class_b = free.classes + b * num_words;
      Word next_to_w = 0;
      Word next_to_both = 0;
      for (std::size_t k = 0; k < num_words; ++k) {
        next_to_w |= class_b[k] & w_row[k];
        next_to_both |= class_b[k] & w_row[k] & v_row[k];
      }
      if (deadline->IsOver(num_words)) return true;
      if (next_to_w == 0) {
        class_a[WordOf(w)] &= ~BitOf(w);
        class_b[WordOf(w)] |= BitOf(w);
        class_a[WordOf(v)] |= BitOf(v);
        return true;
      }
      if (next_to_both == 0 && conflict == free.num_classes) conflict = b;
    }
    if (conflict < free.num_classes) {
      free.is_spent[a] = 1;
      free.is_spent[conflict] = 1;
      return true;
    }
  }
  return false;
}

// Equation (1): the candidates that need a branch, in ascending order of
// bounds, if cliques of up to `num_free` vertices are of no interest. Returns
// false if time is up.
QUATRO_SIMD_CLONES bool ColorBranches(const Graph& graph,
                                      const std::vector<Word>& candidates,
                                      int num_free,
                                      ColoringScratch* scratch,
                                      Deadline* deadline,
                                      std::vector<Branch>* branches) {
  const std::size_t num_words = candidates.size();
  branches->clear();
  scratch->uncolored = candidates;
  scratch->open.resize(num_words);
  const auto num_free_classes = static_cast<std::size_t>(num_free);
  if (scratch->classes.size() < num_free_classes * num_words) {
    scratch->classes.resize(num_free_classes * num_words);
  }
  scratch->is_spent.assign(num_free_classes, 0);
  Word* const uncolored = scratch->uncolored.data();
  Word* const open = scratch->open.data();
  const FreeClasses free{graph,
                         num_words,
                         num_free_classes,
                         scratch->classes.data(),
                         scratch->is_spent.data()};

  int color = 0;
  for (std::size_t first = 0;;) {
    while (first < num_words && uncolored[first] == 0) ++first;
    if (first == num_words) return !deadline->IsOver(0);
    const bool is_free = color < num_free;
    Word* const members =
        is_free ? free.classes + static_cast<std::size_t>(color) * num_words
                : nullptr;
    if (is_free) std::fill(members, members + num_words, Word{0});
    std::copy(uncolored + first, uncolored + num_words, open + first);
    bool is_empty = true;
    for (std::size_t w = first; w < num_words;) {
      if (open[w] == 0) {
        ++w;
        continue;
      }
      const int v =
          static_cast<int>(w) * Graph::kWordBits + std::countr_zero(open[w]);
      open[w] &= open[w] - 1;
      uncolored[w] &= ~BitOf(v);
      if (deadline->IsOver(num_words)) return false;
      if (is_free) {
        members[w] |= BitOf(v);
      } else if (FindRoom(v, free, deadline)) {
        continue;
      } else {
        branches->push_back({v, color + 1});
      }
      is_empty = false;
      const Word* const row = graph.Row(v).data();
      for (std::size_t k = w; k < num_words; ++k) open[k] &= ~row[k];
    }
    if (!is_empty) ++color;
  }
}

// Removes candidates with fewer than `min_degree` neighbors among the
// candidates until no such candidate is left. Returns the number of candidates
// that remain.
QUATRO_SIMD_CLONES int DropLowDegrees(const Graph& graph,
                                      int min_degree,
                                      Deadline* deadline,
                                      std::vector<Word>* candidates) {
  const std::size_t num_words = candidates->size();
  Word* const words = candidates->data();
  for (;;) {
    int num_left = 0;
    bool is_settled = true;
    for (std::size_t w = 0; w < num_words; ++w) {
      for (Word left = words[w]; left != 0; left &= left - 1) {
        const int v =
            static_cast<int>(w) * Graph::kWordBits + std::countr_zero(left);
        const Word* const row = graph.Row(v).data();
        int degree = 0;
        for (std::size_t k = 0; k < num_words; ++k) {
          degree += std::popcount(words[k] & row[k]);
        }
        if (deadline->IsOver(num_words)) return num_left;
        if (degree >= min_degree) {
          ++num_left;
        } else {
          words[w] &= ~BitOf(v);
          is_settled = false;
        }
      }
    }
    if (is_settled) return num_left;
  }
}

// The subgraph of `vertices`, with vertices[k] renamed k. Edges are missing if
// time is up.
Graph Subgraph(const Graph& graph,
               const std::vector<int>& vertices,
               Deadline* deadline) {
  std::vector<int> name(static_cast<std::size_t>(graph.num_vertices()));
  std::vector<Word> is_member(NumWords(graph.num_vertices()), 0);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    name[static_cast<std::size_t>(vertices[k])] = static_cast<int>(k);
    is_member[WordOf(vertices[k])] |= BitOf(vertices[k]);
  }
  Graph subgraph(static_cast<int>(vertices.size()));
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const auto row = graph.Row(vertices[k]);
    const auto new_row = subgraph.MutableRow(static_cast<int>(k));
    std::size_t base = 0;
    for (std::size_t w = 0; w < row.size(); ++w, base += Graph::kWordBits) {
      for (Word left = row[w] & is_member[w]; left != 0; left &= left - 1) {
        const int j =
            name[base + static_cast<std::size_t>(std::countr_zero(left))];
        new_row[WordOf(j)] |= BitOf(j);
      }
    }
    // Single bits take about ten times as long as whole words.
    if (deadline->IsOver(10 * row.size())) break;
  }
  return subgraph;
}

template <typename Visit>
void ForEachBit(const std::vector<Word>& bits, const Visit& visit) {
  int base = 0;
  for (Word word : bits) {
    for (; word != 0; word &= word - 1) visit(base + std::countr_zero(word));
    base += Graph::kWordBits;
  }
}

// Grows a clique from `start`, each time by the lowest-numbered vertex that is
// adjacent to all chosen so far.
std::vector<int> GrowClique(const Graph& graph,
                            int start,
                            std::vector<Word> candidates) {
  std::vector<int> clique;
  for (int next = start; next >= 0;) {
    clique.push_back(next);
    const auto row = graph.Row(next);
    // A vertex is not its own neighbor, so this also removes `next`.
    for (std::size_t w = 0; w < candidates.size(); ++w) candidates[w] &= row[w];
    next = -1;
    for (std::size_t w = 0; w < candidates.size() && next < 0; ++w) {
      if (candidates[w] == 0) continue;
      next = static_cast<int>(w) * Graph::kWordBits +
             std::countr_zero(candidates[w]);
    }
  }
  return clique;
}

class Search {
 public:
  Search(const Graph& graph, const ExactCliqueOptions& options)
      : graph_(graph),
        deadline_(options.time_limit_seconds),
        ratio_(options.near_clique_ratio) {}

  ExactCliqueSummary Run() {
    using enum ExactCliqueTermination;
    const bool is_complete = Prepare() && SearchRoot();
    ExactCliqueSummary summary;
    summary.clique = best_;
    std::sort(summary.clique.begin(), summary.clique.end());
    summary.upper_bound = is_complete ? BestSize() : bound_;
    summary.is_optimal = summary.upper_bound == BestSize();
    summary.num_branches = num_branches_;
    summary.termination = summary.is_optimal ? kOptimal
                          : IsNearBound()    ? kNearClique
                                             : kTimeLimit;
    std::ostringstream message;
    message << "a clique of " << BestSize();
    if (summary.is_optimal) {
      message << ", which is the largest";
    } else {
      message << "; the largest has at most " << bound_ << "; stopped by "
              << (summary.termination == kNearClique ? "near_clique_ratio"
                                                     : "time_limit_seconds");
    }
    summary.message = message.str();
    return summary;
  }

 private:
  struct Level {
    std::vector<Word> candidates;
    std::vector<Branch> branches;
  };

  int BestSize() const { return static_cast<int>(best_.size()); }
  bool IsNearBound() const { return BestSize() >= ratio_ * bound_; }

  // Computes bounds and a first clique. Returns false if no search is needed.
  bool Prepare() {
    CoreDecomposition cores = DecomposeCores(graph_);
    if (cores.order.empty()) return false;
    bound_ = cores.max_core + 1;

    // Highest core first, so that the first bit of a set is its best candidate.
    std::reverse(cores.order.begin(), cores.order.end());
    std::vector<Word> candidates = FirstBits(graph_.num_vertices());
    for (const int v : cores.order) {
      if ((candidates[WordOf(v)] & BitOf(v)) == 0) continue;
      best_.push_back(v);
      const auto row = graph_.Row(v);
      for (std::size_t w = 0; w < row.size(); ++w) candidates[w] &= row[w];
    }
    if (IsNearBound()) return false;

    const auto core_of = [&](int k) {
      const int vertex = cores.order[static_cast<std::size_t>(k)];
      return cores.core_number[static_cast<std::size_t>(vertex)];
    };
    int end = graph_.num_vertices();
    const auto drop_low_cores = [&] {
      while (end > 0 && core_of(end - 1) < BestSize()) --end;
    };
    drop_low_cores();
    order_.assign(cores.order.begin(), cores.order.begin() + end);
    ordered_ = Subgraph(graph_, order_, &deadline_);

    std::vector<Branch> branches;
    if (!ColorBranches(
            ordered_, FirstBits(end), 0, &scratch_, &deadline_, &branches)) {
      return false;
    }
    // All vertices of a larger clique are in `ordered_`.
    bound_ = std::min(bound_, std::max(BestSize(), branches.back().bound));
    if (IsNearBound()) return false;

    for (int k = 0; k < end; ++k) {
      const std::vector<int> clique = GrowClique(ordered_, k, FirstBits(end));
      if (deadline_.IsOver(clique.size() * NumWords(end))) return false;
      if (clique.size() <= best_.size()) continue;
      best_.clear();
      for (const int i : clique) {
        best_.push_back(order_[static_cast<std::size_t>(i)]);
      }
      if (IsNearBound()) return false;
      drop_low_cores();
    }
    order_.resize(static_cast<std::size_t>(end));
    return true;
  }

  // Returns whether the search was completed.
  bool SearchRoot() {
    if (order_.empty()) return true;
    ++num_branches_;
    levels_.resize(static_cast<std::size_t>(bound_) + 1);
    Level root;
    root.candidates = FirstBits(static_cast<int>(order_.size()));
    if (!ColorBranches(ordered_,
                       root.candidates,
                       BestSize(),
                       &scratch_,
                       &deadline_,
                       &root.branches)) {
      return false;
    }
    for (std::size_t i = root.branches.size(); i-- > 0;) {
      const auto [vertex, bound] = root.branches[i];
      if (bound <= BestSize()) return true;
      bound_ = std::min(bound_, bound);
      if (IsNearBound()) return false;
      if (!SearchBranch(vertex, root.candidates)) return false;
      root.candidates[WordOf(vertex)] &= ~BitOf(vertex);
    }
    return true;
  }

  // Searches cliques that contain `root` and candidates. Returns false if time
  // is up.
  bool SearchBranch(int root, const std::vector<Word>& root_candidates) {
    Level& level = levels_.front();
    level.candidates = root_candidates;
    const auto row = ordered_.Row(root);
    for (std::size_t w = 0; w < level.candidates.size(); ++w) {
      level.candidates[w] &= row[w];
    }
    const int num_left =
        DropLowDegrees(ordered_, BestSize() - 1, &deadline_, &level.candidates);
    if (num_left < BestSize()) return !deadline_.IsOver(0);
    ++num_branches_;
    if (!ColorBranches(ordered_,
                       level.candidates,
                       BestSize() - 1,
                       &scratch_,
                       &deadline_,
                       &level.branches)) {
      return false;
    }
    if (level.branches.empty()) return true;

    std::vector<int> vertices;
    ForEachBit(level.candidates, [&](int v) { vertices.push_back(v); });
    Graph subgraph = Subgraph(ordered_, vertices, &deadline_);
    std::vector<int> order = DecomposeCores(subgraph).order;
    std::reverse(order.begin(), order.end());
    subgraph = Subgraph(subgraph, order, &deadline_);
    names_.clear();
    for (const int k : order) {
      const int vertex = vertices[static_cast<std::size_t>(k)];
      names_.push_back(order_[static_cast<std::size_t>(vertex)]);
    }
    if (deadline_.IsOver(0)) return false;

    root_ = order_[static_cast<std::size_t>(root)];
    current_.clear();
    level.candidates = FirstBits(subgraph.num_vertices());
    return Expand(subgraph, 0);
  }

  // Searches cliques that contain root_, current_ and candidates of the level.
  // Returns false if time is up.
  bool Expand(const Graph& subgraph, std::size_t depth) {
    ++num_branches_;
    Level& level = levels_[depth];
    const int size = static_cast<int>(depth) + 1;
    if (!ColorBranches(subgraph,
                       level.candidates,
                       std::max(0, BestSize() - size),
                       &scratch_,
                       &deadline_,
                       &level.branches)) {
      return false;
    }
    for (std::size_t i = level.branches.size(); i-- > 0;) {
      const auto [vertex, bound] = level.branches[i];
      if (size + bound <= BestSize()) return true;
      Level& next = levels_[depth + 1];
      next.candidates.resize(level.candidates.size());
      const auto row = subgraph.Row(vertex);
      Word any = 0;
      for (std::size_t w = 0; w < row.size(); ++w) {
        next.candidates[w] = level.candidates[w] & row[w];
        any |= next.candidates[w];
      }
      current_.push_back(vertex);
      if (any != 0) {
        if (!Expand(subgraph, depth + 1)) return false;
      } else if (size + 1 > BestSize()) {
        best_.assign(1, root_);
        for (const int k : current_) {
          best_.push_back(names_[static_cast<std::size_t>(k)]);
        }
      }
      current_.pop_back();
      level.candidates[WordOf(vertex)] &= ~BitOf(vertex);
    }
    return true;
  }

  const Graph& graph_;
  Deadline deadline_;
  double ratio_;
  std::vector<int> best_;  // In the caller's numbering.
  int bound_ = 0;
  std::int64_t num_branches_ = 0;

  // The vertices that the core numbers leave, highest core first. Vertex k is
  // order_[k].
  Graph ordered_{0};
  std::vector<int> order_;

  // The current branch at the root; root_ and names_ are in the caller's
  // numbering.
  int root_ = 0;
  std::vector<int> names_;
  std::vector<int> current_;
  std::vector<Level> levels_;  // Indexed by the size of current_.
  ColoringScratch scratch_;
};

}  // namespace

bool ExactCliqueOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(time_limit_seconds > 0.0)) {
    problem << "exact_clique.time_limit_seconds = " << time_limit_seconds
            << ", must be > 0";
  } else if (!(near_clique_ratio > 0.0 && near_clique_ratio <= 1.0)) {
    problem << "exact_clique.near_clique_ratio = " << near_clique_ratio
            << ", must be in (0, 1]";
  }
  *error = problem.str();
  return error->empty();
}

ExactCliqueSummary FindMaximumClique(const Graph& graph,
                                     const ExactCliqueOptions& options) {
  ExactCliqueSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  return Search(graph, options).Run();
}

}  // namespace quatro
