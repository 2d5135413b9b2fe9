#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/verify/verify_memory.h"
#include "framegraph/verify/verify_order.h"
#include "framegraph/verify/verify_rules.h"

/// The verifier's model of one queue and its memory.
namespace fg::check {

/// The contents of some bytes: a version of a resource, written in one frame.
struct Contents {
  std::uint32_t resource = kNone;  ///< kNone: undefined contents.
  std::uint32_t version = 0;
  std::uint32_t frame = 0;
  friend bool operator==(const Contents&, const Contents&) = default;
};

/// Stages and accesses to which a write has been made visible.
struct Visibility {
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 access;
  friend bool operator==(const Visibility&, const Visibility&) = default;
};

/// One mip level of one layer of one physical image, or one physical buffer.
struct Cell {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  Contents contents;
  bool written = false;  ///< False if there has been no write; `write` is then unused.
  OperationOrder::Handle write = 0;
  VkAccessFlags2 writeAccess = VK_ACCESS_2_NONE;
  bool available = false;
  /// The operation of making the write available, if it is; without stages, like a layout transition. Fewer stages can
  /// happen after it than after the write itself.
  OperationOrder::Handle availability = 0;
  std::vector<Visibility> visible;
  std::vector<OperationOrder::Handle> reads;  ///< Reads since the write, one per set of stages.
  std::uint32_t block = kNone;                ///< Its block of shared memory; kNone if it shares none.
  std::string name;
};

/// A barrier: an execution dependency for all commands, and a memory dependency for some cells.
struct Dependency {
  VkPipelineStageFlags2 srcStage;
  VkAccessFlags2 srcAccess;
  VkPipelineStageFlags2 dstStage;
  VkAccessFlags2 dstAccess;
  VkImageLayout oldLayout;
  VkImageLayout newLayout;
  std::vector<std::uint32_t> cells;
};

class Device {
 public:
  std::uint32_t add(Cell cell) {
    cells_.push_back(std::move(cell));
    return static_cast<std::uint32_t>(cells_.size() - 1);
  }
  [[nodiscard]] Cell& cell(std::uint32_t index) { return cells_[index]; }
  [[nodiscard]] std::size_t cellCount() const { return cells_.size(); }
  /// Let cells lie in memory that other blocks may use too.
  void place(const Block& block);

  /// The host's use of a cell before the frame, in a state in which it only reads or also writes the cell.
  void putIntoState(std::uint32_t cell, const Use& use);

  /// Execute one vkCmdPipelineBarrier2. Its dependencies do not order each other.
  void barrier(const std::vector<Dependency>& batch);
  /// Execute a command's access to a cell. A cell that is read must hold `expected`; a written one then holds `result`.
  void access(std::uint32_t cell, const Use& use, const Contents& expected, const Contents& result);
  /// True if the cell's last write is available before a dependency with these source stages.
  [[nodiscard]] bool findsAvailable(VkPipelineStageFlags2 srcStage, const Cell& cell) const;
  /// Check that work which waits only for these stages comes after all accesses to the cell.
  void checkFinished(std::uint32_t cell, VkPipelineStageFlags2 stage);

  /// Set the position of the replay, which is the prefix of every complaint.
  void setPlace(std::string place) { place_ = std::move(place); }
  void complain(const std::string& what);
  [[nodiscard]] std::vector<std::string> takeComplaints() { return std::move(complaints_); }

 private:
  void checkTransition(const Dependency& dependency, std::uint32_t index);
  void transition(const Dependency& dependency, std::uint32_t index);
  [[nodiscard]] const Operation& at(OperationOrder::Handle operation) const { return order_[operation]; }
  /// True if all reads of the cell since its last write fulfil the condition.
  template <typename Condition>
  [[nodiscard]] bool allReads(const Cell& cell, Condition condition) const {
    return std::ranges::all_of(cell.reads, [&](OperationOrder::Handle read) { return condition(order_[read]); });
  }
  /// True if the dependency itself makes the cell's last write available.
  [[nodiscard]] bool makesAvailable(const Dependency& dependency, const Cell& cell) const;
  /// The cells of other resources that have changed some of a cell's bytes and may still be in use.
  [[nodiscard]] std::vector<std::uint32_t> peers(const Cell& cell) const;
  /// Record that a cell's bytes have changed, so that other cells in them hold nothing.
  void takeBytes(std::uint32_t index, const std::vector<std::uint32_t>& peers);

  /// The effect of a dependency on a cell's last write: it becomes visible, and perhaps available first.
  struct Publication {
    const Dependency* dependency;
    std::uint32_t cell;
    bool makesAvailable;
  };
  [[nodiscard]] std::vector<Publication> publications(const std::vector<Dependency>& batch) const;
  void publish(const Publication& publication);

  std::vector<Cell> cells_;
  OperationOrder order_;
  SharedMemory memory_;
  std::uint64_t time_ = 0;  ///< Number of barriers and accesses so far.
  std::string place_;
  std::vector<std::string> complaints_;
};

}  // namespace fg::check
