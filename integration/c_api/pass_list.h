#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include <walr/walr_passes.h>

#include "framegraph/compile/frame_border.h"
#include "framegraph/plan/plan.h"
#include "integration/single_stage.h"

namespace walr::api {

/// Converts a compiled graph to the plain data of walr_passes.h. The data points into the graph, which must outlive it
/// unchanged.
class PassList {
 public:
  struct Options {
    /// Whether resources get places in heaps. Offsets of a plan that no driver has measured are not those of any
    /// device.
    bool heaps = true;
    std::vector<std::uint32_t> libraryBuffers = {};  ///< Resources of the library, which have no barriers in the list.
  };

  /// @param ports of a single stage; they must also outlive the list
  /// @throws Error if the graph has a pass that is not a compute dispatch
  PassList(const fg::GraphDesc& graph, const fg::Plan& plan, std::span<const StagePort> ports, const Options& options);
  PassList(const PassList&) = delete;
  PassList& operator=(const PassList&) = delete;

  [[nodiscard]] const WalrPassList& list() const { return list_; }

 private:
  [[nodiscard]] bool ofLibrary(std::uint32_t resource) const;
  void addResource(const fg::GraphDesc& graph, const fg::Plan& plan, const fg::FrameBorder& border,
                   std::uint32_t index);
  void addPass(const fg::GraphDesc& graph, const fg::PlannedPass& planned);
  std::span<const WalrBarrier> addBarriers(const std::vector<fg::PlannedBarrier>& planned);
  const WalrBinding* const* addBindings(const fg::PassDecl& pass, const fg::Shader& shader);

  Options options_;
  // Deques never move their elements, which `list_` points to.
  std::deque<std::string> texts_;
  std::deque<WalrResource> resources_;
  std::deque<WalrBinding> bindings_;
  std::deque<std::vector<const WalrBinding*>> bindingLists_;
  std::deque<std::vector<WalrSpecialization>> specializations_;
  std::deque<std::vector<WalrHistoryAge>> historyAges_;
  std::deque<std::vector<WalrBarrier>> barriers_;
  std::deque<WalrDispatch> dispatches_;
  std::vector<const WalrResource*> resourceList_;
  std::vector<const WalrDispatch*> dispatchList_;
  std::vector<WalrHeap> heaps_;
  std::vector<WalrPortResource> ports_;
  WalrPassList list_{};
};

}  // namespace walr::api
