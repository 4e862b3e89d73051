// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/neighborhoods.h"

#include <algorithm>
#include <utility>

namespace quatro {
namespace {

// The number of 4-byte elements in a huge page.
constexpr std::size_t kBlockSize = std::size_t{1} << 19;

}  // namespace

std::size_t Neighborhoods::num_neighbors() const {
  std::size_t sum = 0;
  for (const Row& row : rows_) sum += row.size();
  return sum;
}

NeighborhoodsBuilder::NeighborhoodsBuilder(Eigen::Index num_points) {
  const auto n = static_cast<std::size_t>(num_points);
  result_.rows_.resize(n);
  // n points have at most n^2 neighbors.
  block_size_ = std::min(n * n, kBlockSize);
}

NeighborhoodsBuilder::Writer::~Writer() {
  if (block_ != nullptr) builder_->GiveBack(block_);
}

NeighborhoodsBuilder::Writer::Room NeighborhoodsBuilder::Writer::MakeRoom(
    std::size_t max_size) {
  if (block_ == nullptr || block_->Room() < max_size) {
    if (block_ != nullptr) builder_->GiveBack(std::exchange(block_, nullptr));
    block_ = builder_->Take(max_size);
  }
  return {block_->index.data() + block_->used,
          block_->squared_distance.data() + block_->used};
}

void NeighborhoodsBuilder::Writer::Add(Eigen::Index i, std::size_t size) {
  const Room room = MakeRoom(0);
  builder_->result_.rows_[static_cast<std::size_t>(i)] = {
      {room.index, size}, {room.squared_distance, size}};
  block_->used += size;
}

Neighborhoods NeighborhoodsBuilder::Finish() && { return std::move(result_); }

Neighborhoods::Block* NeighborhoodsBuilder::Take(std::size_t max_size) {
  const std::scoped_lock lock(mutex_);
  for (const auto& block : result_.blocks_) {
    if (block->is_taken || block->Room() < max_size) continue;
    block->is_taken = true;
    return block.get();
  }
  result_.blocks_.push_back(
      std::make_unique<Neighborhoods::Block>(std::max(max_size, block_size_)));
  result_.blocks_.back()->is_taken = true;
  return result_.blocks_.back().get();
}

void NeighborhoodsBuilder::GiveBack(Neighborhoods::Block* block) {
  const std::scoped_lock lock(mutex_);
  block->is_taken = false;
}

}  // namespace quatro
