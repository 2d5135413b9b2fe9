#include "framegraph/declare/graph.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "framegraph/declare/access.h"

namespace fg {
namespace {

AccessDecl declareRead(ResourceVersion resource, Access access, std::string_view binding, SourceLocation where) {
  AccessDecl decl;
  decl.resource = resource.resource;
  decl.readVersion = resource.version;
  decl.access = access;
  decl.binding = binding;
  decl.where = where;
  return decl;
}

AccessDecl declareWrite(ResourceVersion resource, Access access, std::string_view binding, SourceLocation where) {
  AccessDecl decl;
  decl.resource = resource.resource;
  (accessInfo(access).reads() ? decl.readVersion : decl.replacesVersion) = resource.version;
  decl.writeVersion = resource.version + 1;
  decl.access = access;
  decl.binding = binding;
  decl.where = where;
  return decl;
}

}  // namespace

PassBuilder& PassBuilder::sample(std::string_view binding, Texture texture, VkFilter filter, Where where) {
  AccessDecl decl = declareRead(texture, Access::SampledRead, binding, where);
  decl.filter = filter;
  graph_->desc_.passes[pass_].accesses.push_back(std::move(decl));
  return *this;
}

PassBuilder& PassBuilder::unread(std::string_view binding, Texture texture, Where where) {
  return bindUnread(texture, Access::SampledRead, binding, where);
}

PassBuilder& PassBuilder::unread(std::string_view binding, Buffer buffer, Where where) {
  return bindUnread(buffer, Access::StorageRead, binding, where);
}

PassBuilder& PassBuilder::sampleIf(bool read, std::string_view binding, Texture texture, Texture standIn, Where where) {
  return read ? sample(binding, texture, VK_FILTER_NEAREST, where) : unread(binding, standIn, where);
}

PassBuilder& PassBuilder::load(std::string_view binding, Texture texture, Where where) {
  return read(texture, Access::StorageRead, binding, where);
}

PassBuilder& PassBuilder::load(std::string_view binding, Buffer buffer, Where where) {
  return read(buffer, Access::StorageRead, binding, where);
}

PassBuilder& PassBuilder::uniform(std::string_view binding, Buffer buffer, Where where) {
  return read(buffer, Access::UniformRead, binding, where);
}

Texture PassBuilder::store(std::string_view binding, Texture texture, Where where) {
  return {write(texture, Access::StorageWrite, binding, where)};
}

Buffer PassBuilder::store(std::string_view binding, Buffer buffer, Where where) {
  return {write(buffer, Access::StorageWrite, binding, where)};
}

Texture PassBuilder::update(std::string_view binding, Texture texture, Where where) {
  return {write(texture, Access::StorageReadWrite, binding, where)};
}

Buffer PassBuilder::update(std::string_view binding, Buffer buffer, Where where) {
  return {write(buffer, Access::StorageReadWrite, binding, where)};
}

Texture PassBuilder::access(Texture texture, Access access, SubresourceRange range, Where where) {
  const ResourceVersion version = touch(texture, access, where);
  graph_->desc_.passes[pass_].accesses.back().range = range;
  return {version};
}

Buffer PassBuilder::access(Buffer buffer, Access access, Where where) {
  return {touch(buffer, access, where)};
}

PassBuilder& PassBuilder::read(ResourceVersion resource, Access access, std::string_view binding, Where where) {
  graph_->desc_.passes[pass_].accesses.push_back(declareRead(resource, access, binding, where));
  return *this;
}

PassBuilder& PassBuilder::bindUnread(ResourceVersion resource, Access access, std::string_view binding, Where where) {
  read(resource, access, binding, where);
  graph_->desc_.passes[pass_].accesses.back().unread = true;
  return *this;
}

ResourceVersion PassBuilder::write(ResourceVersion resource, Access access, std::string_view binding, Where where) {
  GraphDesc& desc = graph_->desc_;
  desc.passes[pass_].accesses.push_back(declareWrite(resource, access, binding, where));
  if (resource.resource < desc.resources.size()) ++desc.resources[resource.resource].versions;
  return {resource.resource, resource.version + 1};
}

ResourceVersion PassBuilder::touch(ResourceVersion resource, Access access, Where where) {
  if (accessInfo(access).writes()) return write(resource, access, {}, where);
  read(resource, access, {}, where);
  return resource;
}

ComputeDispatch* PassBuilder::computeWork() {
  return std::get_if<ComputeDispatch>(&graph_->desc_.passes[pass_].work);
}

PassBuilder& PassBuilder::constants(std::span<const std::byte> bytes) {
  if (auto* work = computeWork()) work->constants.assign(bytes.begin(), bytes.end());
  return *this;
}

PassBuilder& PassBuilder::appendConstant(std::uint32_t value) {
  if (auto* work = computeWork()) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    work->constants.insert(work->constants.end(), bytes.begin(), bytes.end());
  }
  return *this;
}

PassBuilder& PassBuilder::historyAge(const History& history, std::uint32_t offset) {
  if (auto* work = computeWork()) work->historyAges.push_back({history.index, offset});
  return *this;
}

PassBuilder& PassBuilder::specialize(std::string_view constant, std::uint32_t value) {
  ComputeDispatch* work = computeWork();
  if (work == nullptr) return *this;
  const auto& constants = work->shader->constants;
  const auto found = std::ranges::find(constants, constant, &ShaderConstant::name);
  if (found == constants.end()) {
    work->unknownConstants.emplace_back(constant);
  } else {
    const auto index = static_cast<std::size_t>(found - constants.begin());
    work->specialization[index] = value;
    work->specialized[index] = true;
  }
  return *this;
}

PassBuilder& PassBuilder::specialize(std::string_view constant, float value) {
  return specialize(constant, std::bit_cast<std::uint32_t>(value));
}

PassBuilder& PassBuilder::specialize(std::string_view constant, bool value) {
  return specialize(constant, std::uint32_t{value});
}

PassBuilder& PassBuilder::texels(Extent extent) {
  graph_->desc_.passes[pass_].extent = extent;
  return *this;
}

PassBuilder& PassBuilder::dispatch(Extent threads, std::uint32_t layers) {
  ComputeDispatch* work = computeWork();
  if (work == nullptr) return *this;
  const std::uint32_t counts[3] = {threads.width, threads.height, layers};
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t size = std::max(work->shader->localSize[axis], 1u);
    work->groups[axis] = counts[axis] / size + (counts[axis] % size != 0 ? 1 : 0);
  }
  return *this;
}

PassBuilder& PassBuilder::dispatchIndirect(Buffer arguments, std::uint64_t offset, Where where) {
  if (auto* work = computeWork()) {
    work->indirect = arguments;
    work->indirectOffset = offset;
  }
  return read(arguments, Access::IndirectRead, {}, where);
}

PassBuilder& PassBuilder::sideEffects() {
  graph_->desc_.passes[pass_].sideEffects = true;
  return *this;
}

std::uint32_t Graph::declare(ResourceDecl resource) {
  desc_.resources.push_back(std::move(resource));
  return static_cast<std::uint32_t>(desc_.resources.size() - 1);
}

Texture Graph::texture(std::string name, const TextureDesc& desc, Where where) {
  return {{declare({.name = std::move(name), .desc = desc, .where = where}), 0}};
}

Buffer Graph::buffer(std::string name, const BufferDesc& desc, Where where) {
  return {{declare({.name = std::move(name), .desc = desc, .where = where}), 0}};
}

Buffer Graph::upload(std::string name, std::uint64_t size, Where where) {
  return {
      {declare({.name = std::move(name), .desc = BufferDesc{size}, .lifetime = Lifetime::Upload, .where = where}), 0}};
}

Buffer Graph::upload(std::string name, std::span<const std::byte> contents, Where where) {
  const Buffer buffer = upload(std::move(name), contents.size(), where);
  desc_.resources[buffer.resource].contents = contents;
  return buffer;
}

Texture Graph::import(std::string name, const TextureDesc& desc, const ExternalState& acquire, Where where) {
  return {
      {declare(
           {.name = std::move(name), .desc = desc, .lifetime = Lifetime::Imported, .acquire = acquire, .where = where}),
       0}};
}

Buffer Graph::import(std::string name, const BufferDesc& desc, const ExternalState& acquire, Where where) {
  return {
      {declare(
           {.name = std::move(name), .desc = desc, .lifetime = Lifetime::Imported, .acquire = acquire, .where = where}),
       0}};
}

History Graph::history(std::string name, const TextureDesc& desc, Where where) {
  const auto index = static_cast<std::uint32_t>(desc_.histories.size());
  const auto slot = [&](const char* suffix, Lifetime lifetime) {
    return declare({.name = name + suffix, .desc = desc, .lifetime = lifetime, .history = index, .where = where});
  };
  const std::uint32_t previous = slot(".previous", Lifetime::HistoryPrevious);
  const std::uint32_t current = slot(".current", Lifetime::HistoryCurrent);
  desc_.histories.push_back({std::move(name), previous, current, where});
  return {.previous = {{previous, 0}}, .current = {{current, 0}}, .index = index};
}

void Graph::exported(Texture texture, const ExternalState& release, Where where) {
  desc_.exports.push_back({texture, release, where});
}

void Graph::exported(Buffer buffer, const ExternalState& release, Where where) {
  desc_.exports.push_back({buffer, release, where});
}

PassBuilder Graph::compute(std::string name, const Shader& shader, Where where) {
  ComputeDispatch work;
  work.shader = &shader;
  work.specialization.resize(shader.constants.size());
  work.specialized.resize(shader.constants.size());
  desc_.passes.push_back({.name = std::move(name), .work = std::move(work), .accesses = {}, .where = where});
  return {*this, static_cast<std::uint32_t>(desc_.passes.size() - 1)};
}

PassBuilder Graph::callback(std::string name, std::function<void(const RecordContext&)> record, Where where) {
  desc_.passes.push_back(
      {.name = std::move(name), .work = HostCallback{std::move(record)}, .accesses = {}, .where = where});
  return {*this, static_cast<std::uint32_t>(desc_.passes.size() - 1)};
}

const TextureDesc& Graph::textureDesc(Texture texture) const {
  static const TextureDesc kNoTexture;
  if (texture.resource >= desc_.resources.size()) return kNoTexture;
  const auto* desc = std::get_if<TextureDesc>(&desc_.resources[texture.resource].desc);
  return desc != nullptr ? *desc : kNoTexture;
}

}  // namespace fg
