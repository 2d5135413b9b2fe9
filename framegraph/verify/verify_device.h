#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

/// An access to a cell, or a layout transition of it, that later work may have to wait for.
struct Operation {
  VkPipelineStageFlags2 stage =
      VK_PIPELINE_STAGE_2_NONE;  ///< Stages in which it happens; none for a layout transition.
  VkPipelineStageFlags2 ordered = VK_PIPELINE_STAGE_2_NONE;  ///< Stages of later commands that happen after it.
};

/// Stages and accesses to which a write has been made visible.
struct Visibility {
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 access;
};

/// One mip level of one layer of one physical image, or one physical buffer.
struct Cell {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  Contents contents;
  bool written = false;  ///< False if there has been no write; `write` is then unused.
  Operation write;
  VkAccessFlags2 writeAccess = VK_ACCESS_2_NONE;
  bool available = false;
  /// Stages of later commands that happen after the write has become available. They can be fewer than those that
  /// happen after the write itself.
  VkPipelineStageFlags2 availableTo = VK_PIPELINE_STAGE_2_NONE;
  std::vector<Visibility> visible;
  std::vector<Operation> reads;      ///< Reads since the write, one per set of stages.
  std::vector<std::uint32_t> peers;  ///< Cells of other resources that use some of the same bytes.
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

  /// Execute one vkCmdPipelineBarrier2. Its dependencies do not order each other.
  void barrier(const std::vector<Dependency>& batch);
  /// Execute a command's access to a cell. A cell that is read must hold `expected`; a written one then holds `result`.
  void access(std::uint32_t cell, const Use& use, const Contents& expected, const Contents& result);
  /// Check that work which waits only for these stages comes after all accesses to the cell.
  void checkFinished(std::uint32_t cell, VkPipelineStageFlags2 stage);

  /// Set the position of the replay, which is the prefix of every complaint.
  void setPlace(std::string place) { place_ = std::move(place); }
  void complain(const std::string& what);
  [[nodiscard]] std::vector<std::string> takeComplaints() { return std::move(complaints_); }

 private:
  void checkTransition(const Dependency& dependency, std::uint32_t index);
  void transition(const Dependency& dependency, std::uint32_t index);

  /// The effect of a dependency on a cell's last write: it becomes visible, and perhaps available first.
  struct Publication {
    const Dependency* dependency;
    std::uint32_t cell;
    bool makesAvailable;
  };
  [[nodiscard]] std::vector<Publication> publications(const std::vector<Dependency>& batch) const;
  void publish(const Publication& publication);

  std::vector<Cell> cells_;
  std::string place_;
  std::vector<std::string> complaints_;
};

}  // namespace fg::check
