#include "samples/render/sequence_frame.h"

#include <functional>

namespace walr::render {
namespace {

walr::Image toImage(const Film& film, int components, const std::function<float(std::size_t, int)>& value) {
  walr::Image image(static_cast<int>(film.width), static_cast<int>(film.height), components);
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    for (int c = 0; c < components; ++c) {
      image.pixel(i)[static_cast<std::size_t>(c)] = value(i, c);
    }
  }
  return image;
}

walr::Image toImage(const Film& film, const std::vector<glm::vec3>& values) {
  return toImage(film, 3, [&](std::size_t i, int c) { return values[i][c]; });
}

walr::Image toImage(const Film& film, const std::vector<SpecularPixel>& values) {
  return toImage(film, 3, [&](std::size_t i, int c) { return values[i].light[c]; });
}

walr::Image toImage(const Film& film, glm::vec3 GBufferPixel::*member) {
  return toImage(film, 3, [&](std::size_t i, int c) { return (film.gbuffer[i].*member)[c]; });
}

}  // namespace

walr::Frame frameOfView(const View& view, int number) {
  walr::Frame frame;
  frame.number = number;
  frame.camera.view = view.viewFromWorld;
  frame.camera.previousView = view.previousViewFromWorld;
  frame.camera.projection = view.projection;
  frame.camera.jitter = view.jitter;
  frame.previousProjection = view.projection;
  frame.previousJitter = view.previousJitter;
  return frame;
}

walr::Frame toFrame(const Film& film, const View& view, int number) {
  walr::Frame frame = frameOfView(view, number);
  frame.indirect = toImage(film, film.indirect);
  frame.direct = toImage(film, film.direct);
  frame.albedo = toImage(film, &GBufferPixel::albedo);
  frame.normal = toImage(film, &GBufferPixel::normal);
  frame.depth = toImage(film, 1, [&](std::size_t i, int /*component*/) {
    const GBufferPixel& pixel = film.gbuffer[i];
    return pixel.objectId == GBufferPixel::kSky ? kBackgroundDepth : -pixel.position.z;
  });
  frame.motion = toImage(film, &GBufferPixel::motion);
  frame.emission = toImage(film, &GBufferPixel::emission);
  if (!film.specular.empty()) {
    frame.specular = toImage(film, film.specular);
    frame.specularDistance =
        toImage(film, 1, [&](std::size_t i, int /*component*/) { return film.specular[i].distance; });
    frame.roughness = toImage(film, 1, [&](std::size_t i, int /*component*/) { return film.specular[i].roughness; });
    frame.specularAlbedo = toImage(film, 3, [&](std::size_t i, int c) { return film.specular[i].albedo[c]; });
    frame.specularMotion = toImage(film, 3, [&](std::size_t i, int c) { return film.specular[i].motion[c]; });
  }
  frame.objectId = toImage(film, 1, [&](std::size_t i, int /*component*/) {
    const std::uint32_t id = film.gbuffer[i].objectId;
    return id == GBufferPixel::kSky ? -1.0F : static_cast<float>(id);
  });
  return frame;
}

walr::Reference toReference(const Film& film) {
  walr::Reference reference{toImage(film, film.indirect), toImage(film, film.direct)};
  if (!film.specular.empty()) reference.specular = toImage(film, film.specular);
  return reference;
}

}  // namespace walr::render
