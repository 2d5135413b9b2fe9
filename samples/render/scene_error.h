#pragma once

#include "samples/errors.h"

namespace walr::render {

/// A scene file that cannot be rendered. The message names the file's part that is wrong and, where there is one, the
/// way out.
class SceneError : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace walr::render
