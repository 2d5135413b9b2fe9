#pragma once

#include "samples/render/film.h"
#include "samples/render/view.h"
#include "samples/sequence/frame.h"

namespace walr::render {

/// The camera of a view as a frame without images.
walr::Frame frameOfView(const View& view, int number);

/// Convert a film to a frame in the project's conventions, with direct light and emission.
walr::Frame toFrame(const Film& film, const View& view, int number);

/// Convert the light of a film with many samples per pixel to a reference.
walr::Reference toReference(const Film& film);

}  // namespace walr::render
