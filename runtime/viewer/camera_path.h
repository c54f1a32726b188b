// Camera paths from text files: one camera per frame.
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

/// Parse PX,PY,PZ,TX,TY,TZ,FOV: eye and target in metres, different points, and the full vertical angle, 1 to
/// 170 degrees. None if the text is malformed.
std::optional<shared::Camera> parseCamera(std::string_view text);

/// Format a camera for parseCamera, exact to the last bit of eye and target. Such cameras are level.
std::string formatCamera(const shared::Camera& camera);

/// Read one camera per line; skips empty lines and lines that start with #. errors: input_missing,
/// camera_path.
Result<std::vector<shared::Camera>> readCameraPath(const std::string& path);

/// File name of frame `frame` of a sequence: "a.png" becomes "a-0012.png".
std::string numberedFile(const std::string& path, size_t frame);

} // namespace hearth::viewer
