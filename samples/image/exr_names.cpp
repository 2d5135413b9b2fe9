#include "samples/image/exr_names.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace walr {
namespace {

/// Length of the UTF-8 sequence at the start of a text; 0 if it is none or a control character.
std::size_t printableBytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || (first == 0xc2 && byte(1) < 0xa0)) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return 0;
  }
  return length;
}

/// The name of a part without the view that it ends with.
std::string_view withoutView(std::string_view part, std::string_view view) {
  if (view.empty() || part.size() <= view.size() || !part.ends_with(view)) return part;
  part.remove_suffix(view.size());
  constexpr std::string_view kSeparators = "-._ ";
  if (kSeparators.find(part.back()) != std::string_view::npos) part.remove_suffix(1);
  return part;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t length = printableBytes(text);
    if (length > 0) {
      safe += text.substr(0, length);
    } else {
      constexpr std::string_view kDigits = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(text.front());
      safe.append("\\x") += {kDigits[byte >> 4U], kDigits[byte & 0xfU]};
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return safe;
}

ExrChannelName exrChannelName(const ExrChannelPlace& place) {
  const std::string_view name = place.channel;
  const std::size_t dot = name.rfind('.');
  if (!place.part.empty()) {
    const std::string layer =
        dot == std::string_view::npos ? std::string(withoutView(place.part, place.view)) + "." : "";
    return {layer + std::string(name), std::string(place.view)};
  }
  if (!place.view.empty() || place.views.empty()) return {std::string(name), std::string(place.view)};
  if (dot == std::string_view::npos) return {std::string(name), place.views.front()};
  const std::string_view layer = name.substr(0, dot);
  for (const std::string& view : place.views) {
    if (layer == view) return {std::string(name.substr(dot + 1)), view};
    if (layer.ends_with("." + view)) {
      return {std::string(layer.substr(0, layer.size() - view.size())) + std::string(name.substr(dot + 1)), view};
    }
  }
  return {std::string(name), {}};
}

std::string withView(const ExrChannelName& channel) {
  if (channel.view.empty()) return channel.name;
  const std::size_t dot = channel.name.rfind('.');
  if (dot == std::string::npos) return channel.view + "." + channel.name;
  return channel.name.substr(0, dot + 1) + channel.view + channel.name.substr(dot);
}

}  // namespace walr
