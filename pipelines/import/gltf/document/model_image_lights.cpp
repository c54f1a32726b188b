// Reads the image-based lights of EXT_lights_image_based.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/model_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace hearth::import
{

namespace
{

constexpr uint64_t kMaxFaceSize = 4096; ///< that of environment.sky_size; six faces take 1.2 GB
constexpr size_t kFaces = 6;
constexpr size_t kHarmonics = 9;

void fail(const GltfObject& light, std::string_view property, std::string detail)
{
    const std::optional<Json> value = light.json().find(property);
    light.problems().fail(Issue::gltf_extension_value, value ? *value : light.json(),
                          fmt::format("{} {}", property, detail));
}

/// Return the rotation with length 1. The digits of exporters may be off by rounding, but not by more.
std::array<float, 4> readRotation(const GltfObject& light)
{
    constexpr double kRounding = 1e-3;
    std::array<float, 4> rotation = light.numbers<4>("rotation", {0, 0, 0, 1});
    double square = 0;
    for (const float value : rotation)
        square += double{value} * double{value};
    const double length = std::sqrt(square);
    if (std::abs(length - 1) > kRounding)
    {
        fail(light, "rotation", fmt::format("must be a quaternion of length 1, but has {:.6g}", length));
        return {0, 0, 0, 1};
    }
    for (float& value : rotation)
        value = static_cast<float>(double{value} / length);
    return rotation;
}

/// Check the coefficients, which are not kept: the cook computes those of the faces.
void checkCoefficients(const GltfObject& light)
{
    constexpr std::string_view kProperty = "irradianceCoefficients";
    const std::vector<std::vector<float>> rows = light.numberLists(kProperty, Need::required);
    const bool are_colors =
        std::ranges::all_of(rows, [](const std::vector<float>& row) { return row.size() == 3; });
    if (light.has(kProperty) && (rows.size() != kHarmonics || !are_colors))
        fail(light, kProperty, "must be 9 lists of 3 numbers");
}

GltfImageLight readImageLight(const GltfObject& object, size_t image_count)
{
    GltfImageLight light;
    light.name = object.text("name");
    light.intensity = object.number("intensity", 1);
    if (light.intensity < 0)
        fail(object, "intensity", fmt::format("must not be negative, but is {}", light.intensity));
    light.rotation = readRotation(object);
    checkCoefficients(object);
    light.face_size = static_cast<uint32_t>(object.integer("specularImageSize", {1, kMaxFaceSize}, {}));
    if (!std::has_single_bit(light.face_size))
        fail(object, "specularImageSize", fmt::format("must be a power of two, but is {}", light.face_size));
    light.faces_of_mip = object.indexLists("specularImages", image_count, Need::required);
    const bool has_all = std::ranges::all_of(light.faces_of_mip, [](const std::vector<uint32_t>& faces)
                                             { return faces.size() == kFaces; });
    if (object.has("specularImages") && (light.faces_of_mip.empty() || !has_all))
        fail(object, "specularImages", "must be lists of 6 images, one list at least");
    return light;
}

} // namespace

void readImageLights(const GltfObject& root, GltfModel& model)
{
    const auto extension = root.extension("EXT_lights_image_based");
    if (!extension)
        return;
    for (const GltfObject& object : extension->objects("lights", Need::required))
        model.image_lights.push_back(readImageLight(object, model.images.size()));
}

} // namespace hearth::import
