#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/verify/verify_rules.h"

/// The checker's model of one queue and of the memory that it works on.
namespace fg::check {

/// What some bytes hold: a version of a resource as made in one frame.
struct Contents {
  std::uint32_t resource = kNone;  ///< kNone: garbage.
  std::uint32_t version = 0;
  std::uint32_t frame = 0;
  friend bool operator==(const Contents&, const Contents&) = default;
};

/// Something that was done to a cell and that later work may have to wait for.
struct Operation {
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;    ///< In which it happens; none for a layout transition.
  VkPipelineStageFlags2 ordered = VK_PIPELINE_STAGE_2_NONE;  ///< Stages of later commands that happen after it.
};

/// Accesses in a set of stages to which a write has been made visible.
struct Visibility {
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 access;
};

/// One mip level of one layer of one physical image, or one physical buffer.
struct Cell {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  Contents contents;
  bool written = false;  ///< Whether `write` stands for anything.
  Operation write;
  VkAccessFlags2 writeAccess = VK_ACCESS_2_NONE;
  bool available = false;
  /// Stages of later commands that happen after the write was made available, which can be fewer than those that happen
  /// after the write.
  VkPipelineStageFlags2 availableTo = VK_PIPELINE_STAGE_2_NONE;
  std::vector<Visibility> visible;
  std::vector<Operation> reads;      ///< Since the write, one for each stage.
  std::vector<std::uint32_t> peers;  ///< Cells of other resources in the same bytes.
  std::string name;
};

/// A dependency that applies to some cells' memory and to everybody's execution.
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

  /// One vkCmdPipelineBarrier2: its dependencies do not order each other.
  void barrier(const std::vector<Dependency>& batch);
  /// A command's access to a cell, which must hold `expected` if it is read, and holds `result` once written.
  void access(std::uint32_t cell, const Use& use, const Contents& expected, const Contents& result);
  /// Check that who goes on from a state of a cell, and waits for its stages only, waits for all that was done to it.
  void checkFinished(std::uint32_t cell, VkPipelineStageFlags2 stage);

  /// Said before every complaint: where the replay stands.
  void setPlace(std::string place) { place_ = std::move(place); }
  void complain(const std::string& what);
  [[nodiscard]] std::vector<std::string> takeComplaints() { return std::move(complaints_); }

 private:
  void checkTransition(const Dependency& dependency, std::uint32_t index);
  void transition(const Dependency& dependency, std::uint32_t index);

  /// What a dependency does for a cell's last write.
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
