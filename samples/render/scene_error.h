#pragma once

#include "samples/errors.h"

namespace walr::render {

/// Thrown for a scene file that cannot be rendered. The message names the wrong part of the file and, where there is
/// one, a remedy.
class SceneError : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace walr::render
