#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>
#include <set>

#include "framegraph/compile/access_history.h"
#include "framegraph/compile/alias.h"
#include "framegraph/compile/compile.h"
#include "framegraph/compile/heap_packing.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/plan/memory_places.h"
#include "framegraph/verify/verify.h"
#include "framegraph/verify/verify_rules.h"
#include "tests/framegraph/dependency_chains.h"
#include "tests/framegraph/random_graph.h"

namespace fg::test {
namespace {

std::uint64_t fromEnvironment(const char* variable, std::uint64_t otherwise) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// Seeds of this run: WALR_SEED is the first seed, WALR_GRAPHS the number of graphs.
struct Seeds {
  std::uint64_t first = fromEnvironment("WALR_SEED", 1);
  std::uint64_t count = fromEnvironment("WALR_GRAPHS", 20'000);
};

/// Most graphs are small, so that many can be tried. One in 20 has a medium size, and one in 2,000 is large.
RandomGraphLimits limitsOf(std::uint64_t seed) {
  if (seed % 2'000 == 0) return {100, 150};
  if (seed % 20 == 0) return {15, 40};
  return {};
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Statistics of aliased peak / lower bound over many graphs.
struct Ratios {
  double sum = 0;
  double worst = 1;
  std::uint64_t count = 0;

  void add(std::uint64_t peak, std::uint64_t bound) {
    const double ratio = static_cast<double>(peak) / static_cast<double>(bound);
    sum += ratio;
    worst = std::max(worst, ratio);
    ++count;
  }
  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

/// The lower bound of memory that a packing can reach: it includes that a write that no pass reads holds its bytes for
/// one more batch.
std::uint64_t lowerBoundOfHeld(const GraphDesc& graph, const Plan& plan) {
  const AccessHistory accesses(graph, plan);
  std::vector<HeapRequest> requests;
  for (std::uint32_t i = 0; i < plan.resources.size(); ++i) {
    const PlannedResource& resource = plan.resources[i];
    if (resource.heap == kNone) continue;
    const std::uint32_t first = plan.passes[resource.firstUse].batch;
    requests.push_back({resource.size, resource.alignment, first, heldUntil(accesses, plan, i)});
  }
  return lowerBound(requests);
}

/// Bytes of the heaps that hold histories.
std::uint64_t heapsOfHistories(const Plan& plan) {
  std::uint64_t bytes = 0;
  for (const PlannedHeap& heap : plan.heaps) bytes += heap.partner != kNone ? heap.size : 0;
  return bytes;
}

TEST(Fuzz, TheVerifierAcceptsThePlansOfRandomGraphs) {
  const Seeds seeds;
  std::cout << "seeds " << seeds.first << " to " << seeds.first + seeds.count - 1 << "\n";
  Ratios ratios;
  Ratios packingRatios;
  Ratios aliasingRatios;
  for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count; ++seed) {
    const Graph graph = randomGraph(seed, limitsOf(seed));
    const CompileOptions options = {.aliasHistories = seed % 4 != 0};
    const CompileResult result = compile(graph.desc(), TableMemoryModel(), options);
    ASSERT_TRUE(result.ok()) << "seed " << seed << "\n" << result.text();
    const std::vector<std::string> faults = verify(graph.desc(), result.plan);
    ASSERT_TRUE(faults.empty()) << "seed " << seed << "\n" << joined(faults) << toText(graph.desc(), result.plan);
    const MemoryReport& memory = result.plan.memory;
    if (const std::uint64_t bytes = heapsOfHistories(result.plan); bytes != 0) {
      aliasingRatios.add(bytes + memory.transientPeakBytes, bytes + memory.transientLowerBoundBytes);
    }
    if (memory.transientLowerBoundBytes == 0 || options.aliasHistories) continue;
    ratios.add(memory.transientPeakBytes, memory.transientLowerBoundBytes);
    packingRatios.add(memory.transientPeakBytes, lowerBoundOfHeld(graph.desc(), result.plan));
  }
  std::cout << "aliased peak over most bytes alive on " << ratios.count << " graphs: mean " << ratios.mean()
            << ", worst " << ratios.worst << "; over most bytes held: mean " << packingRatios.mean() << ", worst "
            << packingRatios.worst << "; with all histories, on " << aliasingRatios.count
            << " that transients alias: mean " << aliasingRatios.mean() << ", worst " << aliasingRatios.worst << "\n";
  // The project's goal for random graphs.
  EXPECT_LE(ratios.mean(), 1.10);
  EXPECT_LE(aliasingRatios.mean(), 1.10);
}

TEST(Fuzz, RegistrationOrderDoesNotChangeThePlan) {
  const Seeds seeds;
  for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count / 100; ++seed) {
    const Graph graph = randomGraph(seed, limitsOf(seed));
    const GraphDesc other = shuffled(graph.desc(), seed);
    const CompileResult a = compile(graph.desc(), TableMemoryModel());
    const CompileResult b = compile(other, TableMemoryModel());
    ASSERT_EQ(toText(graph.desc(), a.plan), toText(other, b.plan)) << "seed " << seed;
    ASSERT_EQ(a.text(), b.text()) << "seed " << seed;
  }
}

/// One way to damage a plan.
class Mutator {
 public:
  Mutator(const GraphDesc& graph, Plan& plan, std::uint64_t seed) : graph_(graph), plan_(plan), random_(seed) {}

  /// Damage the plan at random. Returns the kind of damage; empty if the plan has nothing to damage in this way.
  std::string run() {
    switch (random_() % 10) {
      case 0:
        return dropBarrier();
      case 1:
        return weaken("source stage", &PlannedBarrier::srcStage);
      case 2:
        return weaken("destination stage", &PlannedBarrier::dstStage);
      case 3:
        return weakenAccess();
      case 4:
        return changeLayout();
      case 5:
        return random_() % 2 == 0 ? moveOffset() : shortenLifetime();
      case 6:
        return moveToPartner();
      case 7:
        return joinBatches();
      case 8:
        return moveOntoNeighbour();
      default:
        return swapPasses();
    }
  }

 private:
  std::vector<PlannedBarrier>* randomBatch() {
    std::vector<std::vector<PlannedBarrier>*> batches;
    for (PlannedPass& pass : plan_.passes) {
      if (!pass.barriers.empty()) batches.push_back(&pass.barriers);
    }
    if (!plan_.releases.empty()) batches.push_back(&plan_.releases);
    return batches.empty() ? nullptr : batches[random_() % batches.size()];
  }

  std::string dropBarrier() {
    auto* batch = randomBatch();
    if (batch == nullptr) return {};
    const auto victim = batch->begin() + static_cast<std::ptrdiff_t>(random_() % batch->size());
    batch->erase(victim);
    return "drop barrier";
  }

  std::string weaken(const char* what, VkPipelineStageFlags2 PlannedBarrier::*stages) {
    auto* batch = randomBatch();
    if (batch == nullptr) return {};
    PlannedBarrier& barrier = (*batch)[random_() % batch->size()];
    if (barrier.*stages == VK_PIPELINE_STAGE_2_NONE) return {};
    barrier.*stages &= barrier.*stages - 1;
    return what;
  }

  std::string weakenAccess() {
    auto* batch = randomBatch();
    if (batch == nullptr) return {};
    PlannedBarrier& barrier = (*batch)[random_() % batch->size()];
    VkAccessFlags2& access = random_() % 2 == 0 && barrier.srcAccess != 0 ? barrier.srcAccess : barrier.dstAccess;
    if (access == VK_ACCESS_2_NONE) return {};
    access &= access - 1;
    return "access";
  }

  std::string changeLayout() {
    auto* batch = randomBatch();
    if (batch == nullptr) return {};
    PlannedBarrier& barrier = (*batch)[random_() % batch->size()];
    if (!std::holds_alternative<TextureDesc>(graph_.resources[barrier.resource].desc)) return {};
    barrier.newLayout = barrier.newLayout == VK_IMAGE_LAYOUT_GENERAL ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                                                                     : VK_IMAGE_LAYOUT_GENERAL;
    return "layout";
  }

  /// True if a pass after a position reads what a resource holds at that position.
  [[nodiscard]] bool isReadLater(const PlannedResource& planned, std::uint32_t position) const {
    const auto resource = static_cast<std::uint32_t>(&planned - plan_.resources.data());
    std::set<std::uint32_t> held = {0};
    for (std::uint32_t i = 0; i < plan_.passes.size(); ++i) {
      for (const AccessDecl& access : graph_.passes[plan_.passes[i].pass].accesses) {
        if (access.resource != resource) continue;
        if (i > position && held.contains(access.readVersion)) return true;
        if (i <= position && access.writeVersion != kNone) held.insert(access.writeVersion);
      }
    }
    return false;
  }

  /// Place a transient on the bytes of another that is alive at the same time.
  std::string moveOffset() {
    std::vector<std::pair<PlannedResource*, PlannedResource*>> pairs;
    for (PlannedResource& a : plan_.resources) {
      for (PlannedResource& b : plan_.resources) {
        const bool together = &a != &b && a.heap != kNone && a.heap == b.heap && a.firstUse < b.lastUse &&
                              b.firstUse < a.lastUse && a.offset != b.offset && isReadLater(b, a.firstUse);
        if (together && b.offset + a.size <= plan_.heaps[a.heap].size) pairs.emplace_back(&a, &b);
      }
    }
    if (pairs.empty()) return {};
    const auto& [moved, onto] = pairs[random_() % pairs.size()];
    moved->offset = onto->offset;
    return "offset";
  }

  /// Place a transient on the bytes of a history image while that holds something.
  std::string moveToPartner() {
    std::vector<PlannedResource*> candidates;
    for (PlannedResource& a : plan_.resources) {
      if (a.heap == kNone || plan_.heaps[a.heap].partner == kNone) continue;
      const auto index = static_cast<std::size_t>(&a - plan_.resources.data());
      if (graph_.resources[index].lifetime != Lifetime::Transient) continue;
      for (std::uint32_t i = 0; i < plan_.resources.size(); ++i) {
        const PlannedResource& b = plan_.resources[i];
        if (graph_.resources[i].history == kNone || b.heap != plan_.heaps[a.heap].partner) continue;
        const PassSpan span = occupied(graph_, plan_, i);
        const bool together = a.firstUse <= span.last && span.first <= a.lastUse;
        if (together && a.offset < b.offset + b.size && b.offset < a.offset + a.size) candidates.push_back(&a);
      }
    }
    if (candidates.empty()) return {};
    PlannedResource& moved = *candidates[random_() % candidates.size()];
    moved.heap = plan_.heaps[moved.heap].partner;
    return "partner";
  }

  /// Execute two batches as one, with the barriers of both before it.
  std::string joinBatches() {
    if (batchCount(plan_) < 2) return {};
    const std::uint32_t later = 1 + static_cast<std::uint32_t>(random_() % (batchCount(plan_) - 1));
    const auto first = [&](std::uint32_t batch) {
      return std::ranges::lower_bound(plan_.passes, batch, {}, &PlannedPass::batch);
    };
    std::vector<PlannedBarrier>& barriers = first(later)->barriers;
    std::ranges::move(barriers, std::back_inserter(first(later - 1)->barriers));
    barriers.clear();
    for (PlannedPass& pass : plan_.passes) pass.batch -= pass.batch >= later ? 1 : 0;
    return "joined batches";
  }

  /// Place a transient on the bytes of another that is used last in the batch in which the first is used first.
  std::string moveOntoNeighbour() {
    const auto batch = [&](std::uint32_t position) { return plan_.passes[position].batch; };
    std::vector<std::pair<PlannedResource*, PlannedResource*>> pairs;
    for (std::size_t i = 0; i < plan_.resources.size(); ++i) {
      PlannedResource& a = plan_.resources[i];
      if (a.heap == kNone || graph_.resources[i].lifetime != Lifetime::Transient) continue;
      for (PlannedResource& b : plan_.resources) {
        const bool meet = a.heap == b.heap && b.lastUse < a.firstUse && batch(b.lastUse) == batch(a.firstUse);
        const bool fits = b.offset % a.alignment == 0 && b.offset + a.size <= plan_.heaps[a.heap].size;
        if (meet && fits) pairs.emplace_back(&a, &b);
      }
    }
    if (pairs.empty()) return {};
    const auto& [moved, onto] = pairs[random_() % pairs.size()];
    moved->offset = onto->offset;
    return "bytes of a batch";
  }

  std::string shortenLifetime() {
    std::vector<PlannedResource*> candidates;
    for (PlannedResource& resource : plan_.resources) {
      if (resource.firstUse != kNone && resource.firstUse < resource.lastUse) candidates.push_back(&resource);
    }
    if (candidates.empty()) return {};
    --candidates[random_() % candidates.size()]->lastUse;
    return "lifetime";
  }

  /// Swap two neighbours of which the second reads what the first writes.
  std::string swapPasses() {
    std::vector<std::size_t> candidates;
    for (std::size_t i = 1; i < plan_.passes.size(); ++i) {
      const auto& before = graph_.passes[plan_.passes[i - 1].pass].accesses;
      const auto& after = graph_.passes[plan_.passes[i].pass].accesses;
      const bool dependent = std::ranges::any_of(before, [&](const AccessDecl& write) {
        return write.writeVersion != kNone && std::ranges::any_of(after, [&](const AccessDecl& read) {
                 return read.resource == write.resource && read.readVersion == write.writeVersion;
               });
      });
      if (dependent) candidates.push_back(i);
    }
    if (candidates.empty()) return {};
    const std::size_t i = candidates[random_() % candidates.size()];
    std::swap(plan_.passes[i - 1].pass, plan_.passes[i].pass);
    return "order";
  }

  const GraphDesc& graph_;
  Plan& plan_;
  std::mt19937_64 random_;
};

/// Kinds of damage that change only the order of accesses, not contents, layouts or places.
const std::set<std::string> kAboutOrder = {"drop barrier", "source stage", "destination stage", "access",
                                           "joined batches"};

/// The verifier must reject a damaged plan, unless the damage is proved harmless: a search must then find a chain of
/// dependencies for every pair of conflicting accesses. Hence a plan in which a chain is missing must be rejected.
TEST(Fuzz, TheVerifierRejectsDamagedPlans) {
  struct Score {
    std::uint64_t rejected = 0;
    std::uint64_t proved = 0;
  };
  const Seeds seeds;
  std::map<std::string, Score> scores;
  for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count / 10; ++seed) {
    const Graph graph = randomGraph(seed, limitsOf(seed));
    const CompileResult result = compile(graph.desc(), TableMemoryModel());
    Plan damaged = result.plan;
    const std::string mutation = Mutator(graph.desc(), damaged, seed).run();
    if (mutation.empty() || damaged == result.plan) continue;
    if (!verify(graph.desc(), damaged).empty()) {
      ++scores[mutation].rejected;
      continue;
    }
    const std::vector<std::string> unordered = unorderedAccesses(graph.desc(), damaged);
    ASSERT_TRUE(kAboutOrder.contains(mutation) && unordered.empty())
        << "seed " << seed << ": " << mutation << "\n"
        << joined(unordered) << toText(graph.desc(), result.plan) << "\ndamaged:\n"
        << toText(graph.desc(), damaged);
    ++scores[mutation].proved;
  }
  for (const auto& [mutation, score] : scores) {
    std::cout << mutation << ": " << score.rejected << " rejected, " << score.proved << " proved harmless\n";
    EXPECT_GT(score.rejected, 0U) << mutation;
  }
}

/// One stage mask of a barrier, set wrongly.
struct WrongStages {
  std::string kind;
  PlannedBarrier* barrier = nullptr;
  VkPipelineStageFlags2 PlannedBarrier::*stages = nullptr;
};

/// Set a stage mask of a plan wrongly at random, in half of the cases that of a release.
/// @return no kind if the plan has no barrier or the mask stays the same
WrongStages setWrongStages(Plan& plan, std::mt19937_64& random) {
  std::vector<PlannedBarrier*> barriers;
  for (PlannedPass& pass : plan.passes) {
    for (PlannedBarrier& barrier : pass.barriers) barriers.push_back(&barrier);
  }
  const bool release = !plan.releases.empty() && random() % 2 == 0;
  if (!release && barriers.empty()) return {};
  WrongStages wrong;
  wrong.barrier = release ? &plan.releases[random() % plan.releases.size()] : barriers[random() % barriers.size()];
  wrong.stages = random() % 2 == 0 ? &PlannedBarrier::srcStage : &PlannedBarrier::dstStage;
  VkPipelineStageFlags2& stages = wrong.barrier->*wrong.stages;
  const VkPipelineStageFlags2 right = check::expanded(stages);
  constexpr std::array<VkPipelineStageFlags2, 6> kStages = {
      VK_PIPELINE_STAGE_2_NONE,     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
      VK_PIPELINE_STAGE_2_COPY_BIT, VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT,    VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT};
  if (random() % 2 == 0) {
    stages = kStages[random() % kStages.size()];
  } else if (right != 0) {  // Take one of the stages away.
    VkPipelineStageFlags2 rest = right;
    for (auto skip = random() % static_cast<unsigned>(std::popcount(right)); skip > 0; --skip) rest &= rest - 1;
    stages = right & ~(rest & ~(rest - 1));
  }
  if ((right & ~check::expanded(stages)) == 0) return {};
  wrong.kind = std::string(release ? "release" : "barrier") +
               (wrong.stages == &PlannedBarrier::srcStage ? ", source stages" : ", destination stages");
  return wrong;
}

TEST(Fuzz, TheVerifierMissesNoWrongStages) {
  const Seeds seeds;
  const std::uint64_t wanted = seeds.count / 10;
  std::map<std::string, std::uint64_t> rejected;
  std::uint64_t mutations = 0;
  std::uint64_t harmless = 0;
  std::uint64_t missed = 0;
  std::uint64_t seed = seeds.first;
  for (; mutations < wanted; ++seed) {
    const Graph graph = randomGraph(seed, limitsOf(seed));
    CompileResult result = compile(graph.desc(), TableMemoryModel());
    std::mt19937_64 random(seed);
    const WrongStages wrong = setWrongStages(result.plan, random);
    if (wrong.kind.empty()) continue;
    ++mutations;
    if (!verify(graph.desc(), result.plan).empty()) {
      ++rejected[wrong.kind];
    } else if (const std::vector<std::string> unordered = unorderedAccesses(graph.desc(), result.plan);
               unordered.empty()) {
      ++harmless;
    } else {
      ++missed;
      ADD_FAILURE() << "seed " << seed << ": " << wrong.kind << " of "
                    << graph.desc().resources[wrong.barrier->resource].name << "\n"
                    << joined(unordered) << toText(graph.desc(), result.plan);
    }
  }
  std::cout << mutations << " mutations of seeds " << seeds.first << " to " << seed - 1 << ": " << harmless
            << " proved harmless, " << missed << " missed";
  for (const auto& [kind, count] : rejected) std::cout << "; " << kind << ": " << count << " rejected";
  std::cout << "\n";
  EXPECT_EQ(missed, 0U);
  EXPECT_EQ(rejected.size(), 4U);
}

TEST(Fuzz, EveryPairOfConflictingAccessesHasAChainOfDependencies) {
  const Seeds seeds;
  for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count / 100; ++seed) {
    const Graph graph = randomGraph(seed);
    const CompileResult result = compile(graph.desc(), TableMemoryModel());
    const std::vector<std::string> unordered = unorderedAccesses(graph.desc(), result.plan);
    ASSERT_TRUE(unordered.empty()) << "seed " << seed << "\n" << joined(unordered) << toText(graph.desc(), result.plan);
  }
}

}  // namespace
}  // namespace fg::test
