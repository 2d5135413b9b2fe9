#pragma once

#include "samples/render/film.h"
#include "samples/render/view.h"
#include "samples/sequence/frame.h"

namespace walr::render {

/// A rendered frame in the project's conventions, with direct light and emission.
walr::Frame toFrame(const Film& film, const View& view, int number);

/// The light of a frame of many samples.
walr::Reference toReference(const Film& film);

}  // namespace walr::render
