#include "samples/gpu_render/film_tracer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "framegraph/vulkan/staged_image.h"
#include "samples/denoise/device_graph.h"

namespace walr::gpu_render {
namespace {

constexpr VkFormat kDepthFormat = VK_FORMAT_R32_SFLOAT;
constexpr VkFormat kIdFormat = VK_FORMAT_R32_UINT;

}  // namespace

// A graph of one pass, whose textures are read back.
class FilmTracer::Images {
 public:
  Images(const GpuDevice& gpu, const GpuScene& scene, fg::Extent extent) : extent_(extent) {
    const VkFormat color = TracedTextures::format(Precision::Float);
    const auto declare = [&](const char* name, VkFormat format) {
      return graph_.import(name, {.format = format, .extent = extent}, fg::vk::kOverwritable);
    };
    inputs_ = declareTraceInputs(graph_, scene);
    textures_ = {declare("direct light", color), declare("indirect light", color), declare("normal", color),
                 declare("albedo", color),       declare("emission", color),       declare("motion", color),
                 declare("depth", kDepthFormat), declare("object id", kIdFormat)};
    if (scene.specular()) {
      textures_.specular = declare("specular light", color);
      textures_.specularAlbedo = declare("specular albedo", color);
      textures_.specularMotion = declare("specular motion", color);
    }
    addTrace(graph_, scene, Precision::Float, inputs_, textures_);
    std::vector<fg::Texture> traced = {textures_.direct,   textures_.indirect, textures_.normal, textures_.albedo,
                                       textures_.emission, textures_.motion,   textures_.depth,  textures_.objectId};
    if (scene.specular()) {
      traced.insert(traced.end(), {textures_.specular, textures_.specularAlbedo, textures_.specularMotion});
    }
    for (const fg::Texture texture : traced) graph_.exported(texture, fg::vk::kReadable);
    readback_.emplace(gpu, graph_, 1);
    direct_ = readback_->readBack(textures_.direct);
    indirect_ = readback_->readBack(textures_.indirect);
    normal_ = readback_->readBack(textures_.normal);
    albedo_ = readback_->readBack(textures_.albedo);
    emission_ = readback_->readBack(textures_.emission);
    motion_ = readback_->readBack(textures_.motion);
    depth_ = readback_->readBack(textures_.depth);
    objectId_ = readback_->readBack(textures_.objectId);
    if (!scene.specular()) return;
    specular_ = readback_->readBack(textures_.specular);
    specularAlbedo_ = readback_->readBack(textures_.specularAlbedo);
    specularMotion_ = readback_->readBack(textures_.specularMotion);
  }

  [[nodiscard]] fg::Extent extent() const { return extent_; }

  void trace(const TraceData& data) {
    const fg::vk::Frame frame = readback_->begin();
    uploadTrace(readback_->executor(), inputs_, data);
    readback_->submit(frame);
    slot_ = readback_->finish();
  }

  [[nodiscard]] std::vector<glm::vec4> direct() const { return readback_->read<glm::vec4>(direct_, slot_); }
  [[nodiscard]] std::vector<glm::vec4> indirect() const { return readback_->read<glm::vec4>(indirect_, slot_); }

  // Only of scenes with specular light.
  [[nodiscard]] std::vector<glm::vec4> specular() const { return readback_->read<glm::vec4>(specular_, slot_); }
  [[nodiscard]] std::vector<glm::vec4> specularAlbedo() const {
    return readback_->read<glm::vec4>(specularAlbedo_, slot_);
  }
  [[nodiscard]] std::vector<glm::vec4> specularMotion() const {
    return readback_->read<glm::vec4>(specularMotion_, slot_);
  }

  void readSpecular(std::vector<render::SpecularPixel>& pixels) const {
    const auto normal = readback_->read<glm::vec4>(normal_, slot_);
    const auto albedo = specularAlbedo();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      pixels[i].albedo = albedo[i];
      pixels[i].roughness = normal[i].w;
    }
  }

  void readGBuffer(const render::View& view, std::vector<render::GBufferPixel>& pixels) const {
    const auto normal = readback_->read<glm::vec4>(normal_, slot_);
    const auto albedo = readback_->read<glm::vec4>(albedo_, slot_);
    const auto emission = readback_->read<glm::vec4>(emission_, slot_);
    const auto motion = readback_->read<glm::vec4>(motion_, slot_);
    const auto depth = readback_->read<float>(depth_, slot_);
    const auto objectId = readback_->read<std::uint32_t>(objectId_, slot_);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      render::GBufferPixel& pixel = pixels[i];
      pixel.objectId = objectId[i];
      if (pixel.objectId != render::GBufferPixel::kSky) {
        const glm::uvec2 at(i % view.width, i / view.width);
        const glm::vec2 place = (glm::vec2(at) + 0.5F + view.jitter) / glm::vec2(view.width, view.height);
        const glm::vec2 ndc = (place * 2.0F - 1.0F) * glm::vec2(1.0F, -1.0F);
        pixel.position = depth[i] * glm::vec3(ndc.x / view.projection[0][0], ndc.y / view.projection[1][1], -1.0F);
      }
      pixel.normal = normal[i];
      pixel.albedo = albedo[i];
      pixel.emission = emission[i];
      pixel.motion = motion[i];
    }
  }

 private:
  fg::Extent extent_;
  fg::Graph graph_;
  TraceInputs inputs_;
  TracedTextures textures_;
  std::optional<ReadbackGraph> readback_;
  ReadbackGraph::Index direct_ = 0;
  ReadbackGraph::Index indirect_ = 0;
  ReadbackGraph::Index normal_ = 0;
  ReadbackGraph::Index albedo_ = 0;
  ReadbackGraph::Index emission_ = 0;
  ReadbackGraph::Index motion_ = 0;
  ReadbackGraph::Index depth_ = 0;
  ReadbackGraph::Index objectId_ = 0;
  ReadbackGraph::Index specular_ = 0;
  ReadbackGraph::Index specularAlbedo_ = 0;
  ReadbackGraph::Index specularMotion_ = 0;
  std::uint32_t slot_ = 0;
};

struct FilmTracer::Sum {
  std::vector<glm::dvec3> direct;
  std::vector<glm::dvec3> indirect;
  std::vector<double> paths;
  std::vector<glm::dvec4> specular = {};  // w: inverse distances. Empty without specular light.
  std::vector<glm::dvec3> specularMotion = {};
  std::vector<double> specularPaths = {};
  std::uint64_t rays = 0;

  [[nodiscard]] glm::dvec3 mean(const std::vector<glm::dvec3>& sums, std::size_t index) const {
    return sums[index] / std::max(paths[index], 1.0);
  }
  [[nodiscard]] glm::dvec4 meanSpecular(std::size_t index) const {
    return specular[index] / std::max(specularPaths[index], 1.0);
  }
  void add(const Sum& other) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      direct[i] += other.direct[i];
      indirect[i] += other.indirect[i];
      paths[i] += other.paths[i];
    }
    for (std::size_t i = 0; i < specular.size(); ++i) {
      specular[i] += other.specular[i];
      specularMotion[i] += other.specularMotion[i];
      specularPaths[i] += other.specularPaths[i];
    }
    rays += other.rays;
  }
};

FilmTracer::FilmTracer(const GpuDevice& gpu, const render::World& world)
    : gpu_(gpu), world_(world), scene_(gpu, world) {
  scene_.prepare(Precision::Float);
}

FilmTracer::~FilmTracer() = default;

FilmTracer::Sum FilmTracer::trace(const render::View& view, render::SamplingSettings settings,
                                  const render::ReferenceCoverage& coverage, render::Film* film) {
  const fg::Extent extent{view.width, view.height};
  if (images_ == nullptr || images_->extent() != extent) {
    images_.reset();
    images_ = std::make_unique<Images>(gpu_, scene_, extent);
  }
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  // A dispatch is short enough for devices that reset a program after two seconds, and its sums in float lose little.
  constexpr std::uint64_t kPathsOfDispatch = std::uint64_t{1} << 22U;
  constexpr std::uint64_t kMostSamples = 64;
  const auto samplesAtOnce =
      static_cast<std::uint32_t>(std::clamp<std::uint64_t>(kPathsOfDispatch / pixels, 1, kMostSamples));
  Sum sum{std::vector<glm::dvec3>(pixels), std::vector<glm::dvec3>(pixels), std::vector<double>(pixels)};
  if (scene_.specular()) {
    sum.specular.resize(pixels);
    sum.specularMotion.resize(pixels);
    sum.specularPaths.resize(pixels);
  }
  TraceData data{sceneState(world_), scene_.placements(world_), {}};
  const std::uint32_t total = settings.samples;
  const std::uint32_t first = settings.firstSample;
  std::uint64_t reported = 0;
  for (std::uint32_t done = 0; done < total;) {
    settings.firstSample = first + done;
    settings.samples = std::min(samplesAtOnce, total - done);
    data.constants = traceConstants(world_, view, settings, coverage);
    images_->trace(data);
    if (film != nullptr && done == 0) {
      images_->readGBuffer(view, film->gbuffer);
      if (scene_.specular()) images_->readSpecular(film->specular);
    }
    const std::vector<glm::vec4> direct = images_->direct();
    const std::vector<glm::vec4> indirect = images_->indirect();
    for (std::size_t i = 0; i < pixels; ++i) {
      const double paths = direct[i].w;
      sum.direct[i] += glm::dvec3(direct[i]) * paths;
      sum.indirect[i] += glm::dvec3(indirect[i]) * paths;
      sum.paths[i] += paths;
      sum.rays += static_cast<std::uint64_t>(indirect[i].w);
    }
    if (scene_.specular()) {
      const std::vector<glm::vec4> specular = images_->specular();
      const std::vector<glm::vec4> albedo = images_->specularAlbedo();
      const std::vector<glm::vec4> motion = images_->specularMotion();
      for (std::size_t i = 0; i < pixels; ++i) {
        const double paths = albedo[i].w;
        sum.specular[i] += glm::dvec4(specular[i]) * paths;
        sum.specularMotion[i] += glm::dvec3(motion[i]) * paths;
        sum.specularPaths[i] += paths;
      }
    }
    done += settings.samples;
    const std::uint64_t reached = pixels * done / total;
    settings.pixelsDone(reached - reported);
    reported = reached;
  }
  return sum;
}

render::Film FilmTracer::film(const render::View& view, const render::SamplingSettings& settings) {
  render::Film film;
  film.width = view.width;
  film.height = view.height;
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  film.gbuffer.resize(pixels);
  if (scene_.specular()) film.specular.resize(pixels);
  const Sum sum = trace(view, settings, {}, &film);
  for (std::size_t i = 0; i < pixels; ++i) {
    film.direct.emplace_back(sum.mean(sum.direct, i));
    film.indirect.emplace_back(sum.mean(sum.indirect, i));
  }
  for (std::size_t i = 0; i < film.specular.size(); ++i) {
    const glm::dvec4 mean = sum.meanSpecular(i);
    film.specular[i].light = mean;
    film.specular[i].distance = sum.specularPaths[i] > 0.0 ? render::distanceOf(mean.w) : 0.0F;
    film.specular[i].motion = sum.specularMotion[i] / std::max(sum.specularPaths[i], 1.0);
  }
  film.rays = sum.rays;
  return film;
}

walr::Reference FilmTracer::reference(const render::View& view, const render::SamplingSettings& settings,
                                      const render::ReferenceCoverage& coverage, std::uint64_t& rays) {
  render::SamplingSettings half = settings;
  const bool inHalves = settings.samples % 2 == 0;
  std::uint64_t reported = 0;
  std::uint64_t received = 0;
  if (inHalves) {
    half.samples = settings.samples / 2;
    // Each half reports all pixels.
    half.pixelsDone = [&](std::uint64_t count) {
      received += count;
      settings.pixelsDone(received / 2 - reported);
      reported = received / 2;
    };
  }
  Sum sum = trace(view, half, coverage, nullptr);
  std::optional<Sum> first;
  if (inHalves) {
    first = sum;
    half.seed = render::seedOfSecondHalf(settings.seed);
    sum.add(trace(view, half, coverage, nullptr));
  }
  const auto image = [&] { return walr::Image(static_cast<int>(view.width), static_cast<int>(view.height), 3); };
  walr::Reference reference{image(), image(), inHalves ? image() : walr::Image()};
  if (scene_.specular()) reference.specular = image();
  if (scene_.specular() && inHalves) reference.specularHalf = image();
  const auto set = [](walr::Image& target, std::size_t index, const glm::dvec3& value) {
    for (int c = 0; c < 3; ++c) target.pixel(index)[static_cast<std::size_t>(c)] = static_cast<float>(value[c]);
  };
  for (std::size_t i = 0; i < sum.paths.size(); ++i) {
    const auto x = static_cast<std::uint32_t>(i % view.width);
    const auto y = static_cast<std::uint32_t>(i / view.width);
    const bool covered = coverage.covers(x, y);
    const glm::dvec3 nothing(std::numeric_limits<double>::quiet_NaN());
    set(reference.direct, i, covered ? sum.mean(sum.direct, i) : nothing);
    set(reference.indirect, i, covered ? sum.mean(sum.indirect, i) : nothing);
    if (scene_.specular()) {
      set(reference.specular, i, covered ? glm::dvec3(sum.meanSpecular(i)) : nothing);
      if (first) {
        const bool both = first->specularPaths[i] > 0 && first->specularPaths[i] < sum.specularPaths[i];
        set(reference.specularHalf, i, covered ? glm::dvec3((both ? *first : sum).meanSpecular(i)) : nothing);
      }
    }
    if (!first) continue;
    // Where one half met no diffuse surface, the two say nothing of each other.
    const bool both = first->paths[i] > 0 && first->paths[i] < sum.paths[i];
    const glm::dvec3 mean = both ? first->mean(first->indirect, i) : sum.mean(sum.indirect, i);
    set(reference.indirectHalf, i, covered ? mean : nothing);
  }
  rays = sum.rays;
  return reference;
}

}  // namespace walr::gpu_render
