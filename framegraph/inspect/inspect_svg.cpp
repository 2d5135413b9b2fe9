#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "framegraph/declare/topology.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/plan/memory_places.h"

namespace fg {
namespace {

// Pixels.
constexpr double kColumn = 110;
constexpr double kMemoryHeight = 480;
constexpr double kMargin = 40;
constexpr double kNames = 60;

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

class SvgWriter {
 public:
  SvgWriter(const GraphDesc& graph, const Plan& plan) : graph_(graph), plan_(plan), topology_(graph) {
    for (const PlannedHeap& heap : plan.heaps) {
      heapStart_.push_back(bytes_);
      bytes_ += static_cast<double>(heap.size);
    }
    bytes_ = std::max(bytes_, 1.0);
  }

  std::string run() {
    const double width = 2 * kMargin + kColumn * static_cast<double>(std::max<std::size_t>(plan_.passes.size(), 1));
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\""
         << kMemoryHeight + kMargin + kNames << "\" font-family=\"sans-serif\" font-size=\"11\">\n";
    for (const std::uint32_t resource : topology_.resourcesByName()) writeResource(resource);
    for (std::size_t i = 0; i < plan_.passes.size(); ++i) {
      out_ << "<text x=\"" << kMargin + kColumn * static_cast<double>(i) + 4 << "\" y=\""
           << kMemoryHeight + kMargin + 16 + 14 * static_cast<double>(i % 3) << "\">"
           << escaped(graph_.passes[plan_.passes[i].pass].name) << "</text>\n";
    }
    out_ << "<text x=\"" << kMargin << "\" y=\"" << kMargin - 14 << "\">" << plan_.memory.transientPeakBytes
         << " bytes aliased, " << plan_.memory.transientUnaliasedBytes << " unaliased</text>\n</svg>\n";
    return out_.str();
  }

 private:
  void writeResource(std::uint32_t index) {
    const PlannedResource& planned = plan_.resources[index];
    if (planned.heap == kNone) return;
    static constexpr std::array<std::string_view, 6> kFills = {"#8dbbd8", "#f4d9a8", "#b7d7a8",
                                                               "#d8a8c8", "#c8c0e8", "#e8b8a0"};
    const bool transient = graph_.resources[index].lifetime == Lifetime::Transient;
    const auto [first, last] = occupied(graph_, plan_, index);
    const double scale = kMemoryHeight / bytes_;
    const double x = kMargin + kColumn * first;
    const double y = kMargin + scale * (heapStart_[planned.heap] + static_cast<double>(planned.offset));
    const double height = scale * static_cast<double>(planned.size);
    const std::string name = escaped(graph_.resources[index].name);
    out_ << "<g><title>" << name << ": " << planned.size << " bytes, " << escaped(placeText(graph_, plan_, index))
         << "</title><rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << kColumn * (last - first + 1)
         << "\" height=\"" << height << "\" fill=\""
         << (transient ? kFills[topology_.resourceRank(index) % kFills.size()] : "#e4e4e4") << "\" stroke=\"#404040\""
         << (transient ? "" : " stroke-dasharray=\"4 3\"") << "/><text x=\"" << x + 4 << "\" y=\""
         << y + std::min(height / 2 + 4, 20.0) << "\">" << name << "</text></g>\n";
  }

  const GraphDesc& graph_;
  const Plan& plan_;
  Topology topology_;
  std::vector<double> heapStart_;
  double bytes_ = 0;
  std::ostringstream out_;
};

}  // namespace

std::string toSvg(const GraphDesc& graph, const Plan& plan) {
  return SvgWriter(graph, plan).run();
}

}  // namespace fg
