#include "tests/costs/table.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string_view>

namespace walr::costs {
namespace {

using Row = std::vector<std::string>;

constexpr const char* kUnknown = "-";

// As `rowOf` fills them in.
constexpr std::array<std::string_view, 21> kColumns = {
    "pass",          "batch",          "shader",       "threads",        "groups",   "VGPRs",       "LDS",
    "spills",        "scratch",        "waves",        "instructions",   "branches", "fetches",     "ACO cycles",
    "vector a wave", "fetches a wave", "waits a wave", "cycles a pixel", "MB",       "ESTIMATE us", "bound by"};

std::string fixed(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

std::string fixed(const std::optional<double>& value, int digits) {
  return value ? fixed(*value, digits) : kUnknown;
}

Row rowOf(const PassCosts& pass, const MethodCosts& method, const Machine& machine) {
  const auto count = [](std::uint64_t value) { return std::to_string(value); };
  const auto weighed = [&](double WaveCounts::*figure) {
    return pass.wave ? fixed((*pass.wave).*figure, 0) : kUnknown;
  };
  const auto bounds = pass.boundsOn(machine);
  return {pass.pass,
          count(pass.batch),
          pass.shader,
          count(pass.threads),
          count(pass.groups),
          count(pass.compiled.vectorRegisters),
          count(pass.compiled.sharedBytes),
          count(pass.compiled.spills),
          count(pass.compiled.scratchBytes),
          count(pass.compiled.waves),
          count(pass.compiled.instructions),
          count(pass.branches),
          count(pass.fetchInstructions),
          count(pass.compiled.inverseThroughput),
          weighed(&WaveCounts::vector),
          weighed(&WaveCounts::fetches),
          weighed(&WaveCounts::waits),
          fixed(method.cyclesPerPixel(pass), 1),
          fixed(static_cast<double>(pass.bytes) * 1e-6, 1),
          bounds ? fixed(bounds->largest(), 1) : kUnknown,
          bounds ? std::string(bounds->nameOfLargest()) : kUnknown};
}

Row sumsOf(const MethodCosts& method, const Machine& machine) {
  double bytes = 0.0;
  for (const PassCosts& pass : method.passes) bytes += static_cast<double>(pass.bytes);
  Row row(kColumns.size());
  const auto set = [&row](std::string_view column, const std::string& text) {
    row[static_cast<std::size_t>(std::ranges::find(kColumns, column) - kColumns.begin())] = text;
  };
  set("pass", "**sum**");
  set("cycles a pixel", fixed(method.cyclesPerPixel(), 1));
  set("MB", fixed(bytes * 1e-6, 1));
  set("ESTIMATE us", fixed(method.microseconds(machine), 1));
  return row;
}

}  // namespace

std::string costTable(const MethodCosts& costs, const Machine& machine) {
  std::vector<Row> rows = {Row(kColumns.begin(), kColumns.end())};
  for (const PassCosts& pass : costs.passes) rows.push_back(rowOf(pass, costs, machine));
  rows.push_back(sumsOf(costs, machine));

  std::vector<std::size_t> widths(rows[0].size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::ostringstream text;
  const auto isText = [&](std::size_t column) { return column == 0 || column == 2 || column + 1 == widths.size(); };
  const auto write = [&](const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text << "| " << (isText(i) ? std::left : std::right) << std::setw(static_cast<int>(widths[i])) << row[i] << ' ';
    }
    text << "|\n";
  };
  write(rows[0]);
  for (std::size_t i = 0; i < widths.size(); ++i) {
    text << "| " << std::string(widths[i] - 1, '-') << (isText(i) ? '-' : ':') << ' ';
  }
  text << "|\n";
  for (std::size_t i = 1; i < rows.size(); ++i) write(rows[i]);
  return text.str();
}

}  // namespace walr::costs
