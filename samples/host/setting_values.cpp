#include "samples/host/setting_values.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

namespace walr::host {
namespace {

/// Calls a function with a reference to the value of each setting.
template <typename Function>
class EachValue final : public SettingVisitor {
 public:
  explicit EachValue(Function function) : function_(std::move(function)) {}

  void visit(const SettingInfo& /*info*/, float& value) override { function_(value); }
  void visit(const SettingInfo& /*info*/, std::uint32_t& value) override { function_(value); }
  void visit(const SettingInfo& /*info*/, bool& value) override { function_(value); }
  void choice(const SettingInfo& /*info*/, std::span<const std::string_view> /*names*/, std::uint32_t& value) override {
    function_(value);
  }

 private:
  Function function_;
};

}  // namespace

SettingValues::SettingValues(Configurable& method) {
  EachValue keep([this](const auto& value) { values_.emplace_back(value); });
  method.visitSettings(keep);
}

void SettingValues::restore(Configurable& method) const {
  std::size_t next = 0;
  EachValue put([&]<typename Number>(Number& value) { value = std::get<Number>(values_.at(next++)); });
  method.visitSettings(put);
}

}  // namespace walr::host
