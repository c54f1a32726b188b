// Cameras of a sequence of frames, from a text file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "runtime/frame/frame.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::viewer
{

/// PX,PY,PZ,TX,TY,TZ,FOV: eye and target in metres, apart, and the full vertical angle, 1 to 170 degrees. Nothing where
/// the text is not that.
std::optional<shared::Camera> parseCamera(std::string_view text);

/// What parseCamera takes, to the last bit of eye and target. Cameras are level there.
std::string formatCamera(const shared::Camera& camera);

/// One camera a line; empty lines and those that start with # are skipped. errors: input_missing, camera_path.
Result<std::vector<shared::Camera>> readCameraPath(const std::string& path);

/// The file for frame `frame` of a sequence: "a.png" becomes "a-0012.png".
std::string numberedFile(const std::string& path, size_t frame);

} // namespace hearth::viewer
