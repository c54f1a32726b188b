// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/camera_path.h"

#include "formats/base/regular_file.h"
#include "formats/base/text.h"
#include "runtime/viewer/camera_fit.h"
#include "runtime/viewer/text.h"

#include <array>
#include <cstdio>

namespace hearth::viewer
{

namespace
{

constexpr float kRadiansPerDegree = 3.14159265f / 180.0f;

} // namespace

std::optional<shared::Camera> parseCamera(std::string_view text)
{
    const auto parts = splitText(text, ',');
    std::array<float, 7> v{};
    if (parts.size() != v.size())
        return std::nullopt;
    for (size_t i = 0; i < v.size(); ++i)
    {
        const auto number = parseNumber<float>(parts[i]);
        if (!number)
            return std::nullopt;
        v[i] = *number;
    }
    const Float3 position{v[0], v[1], v[2]}, target{v[3], v[4], v[5]};
    const float distance = length(target - position);
    if (!(distance > 0) || v[6] < 1 || v[6] > 170)
        return std::nullopt;
    return shared::Camera{.position = position,
                          .target = target,
                          .y_fov_rad = v[6] * kRadiansPerDegree,
                          .z_near = nearPlane(distance)};
}

std::string formatCamera(const shared::Camera& camera)
{
    const Float3 p = camera.position, t = camera.target;
    const float numbers[] = {p.x, p.y, p.z, t.x, t.y, t.z, camera.y_fov_rad / kRadiansPerDegree};
    std::string text;
    for (const float number : numbers)
    {
        char digits[24];
        std::snprintf(digits, sizeof(digits), "%s%.9g", text.empty() ? "" : ",", double{number});
        text += digits;
    }
    return text;
}

Result<std::vector<shared::Camera>> readCameraPath(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string text, readFile(path));
    std::vector<shared::Camera> cameras;
    size_t number = 0;
    for (std::string& line : splitText(text, '\n'))
    {
        ++number;
        if (!line.empty() && line.back() == '\r')
            line.pop_back();
        if (line.empty() || line.front() == '#')
            continue;
        const auto camera = parseCamera(line);
        if (!camera)
            return Error{Issue::camera_path, path, "line " + std::to_string(number), "\"" + line + "\""};
        cameras.push_back(*camera);
    }
    if (cameras.empty())
        return Error{Issue::camera_path, path, "", "it has no camera"};
    return cameras;
}

std::string numberedFile(const std::string& path, size_t frame)
{
    char number[24];
    std::snprintf(number, sizeof(number), "-%04zu", frame);
    const size_t name = path.find_last_of('/') + 1; // 0 without a folder
    const size_t dot = path.find_last_of('.');
    const size_t at = dot == std::string::npos || dot <= name ? path.size() : dot;
    return path.substr(0, at) + number + path.substr(at);
}

} // namespace hearth::viewer
