// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/image_light.h"

#include "pipelines/import/gltf/images.h"
#include "pipelines/import/images/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace hearth::import
{

namespace
{

using environment::Environment;
using environment::Layout;

/// Faces of a cube being read from the images of a light.
class FaceReader
{
public:
    FaceReader(const GltfModel& model, const GltfBuffers& buffers, const GltfContext& context, uint32_t index)
        : light_(model.image_lights[index]),
          context_(context),
          images_(model, buffers, context),
          where_(fmt::format("/extensions/EXT_lights_image_based/lights/{}", index))
    {
    }

    /// Return the radiance of all directions, in the light's own axes.
    Result<Environment> read()
    {
        const uint32_t side = light_.face_size;
        Environment cube{Layout::cube, side, side, {}};
        const std::vector<uint32_t>& images = light_.faces_of_mip[0];
        for (uint32_t face = 0; face < 6; ++face)
        {
            const ptrdiff_t first = std::ranges::find(images, images[face]) - images.begin();
            if (first == face)
                HEARTH_TRY(addFace(face, cube));
            else // an image that several faces share is read once
                for (size_t i = 0; i < size_t{side} * side; ++i)
                    cube.texels.push_back(cube.texels[static_cast<size_t>(first) * side * side + i]);
        }
        return cube;
    }

private:
    Error faceError(uint32_t face, Issue issue, const std::string& detail) const
    {
        return context_.error(
            issue, fmt::format("{}/specularImages/0/{}", where_, face),
            fmt::format("image \"{}\": {}", images_.imageName(light_.faces_of_mip[0][face]), detail));
    }

    Status addFace(uint32_t face, Environment& cube) const;
    Result<Float3> decodeTexel(uint32_t face, const DecodedImage& image, uint32_t x, uint32_t y) const;

    const GltfImageLight& light_;
    const GltfContext& context_;
    GltfImages images_;
    std::string where_;
};

Status FaceReader::addFace(uint32_t face, Environment& cube) const
{
    Result<DecodedImage> read =
        images_.read(light_.faces_of_mip[0][face], fmt::format("{}/specularImages/0/{}", where_, face));
    if (!read.ok())
        return faceError(face, read.error().issue,
                         read.error().detail.empty() ? std::string(issueInfo(read.error().issue).summary)
                                                     : read.error().detail);
    if (read->isFloat())
        return faceError(face, Issue::image_unsupported, "has floats: faces are RGBD, with D in alpha");
    if (read->width != cube.width || read->height != cube.height)
        return faceError(face, Issue::gltf_extension_value,
                         fmt::format("has {} x {} texels, where specularImageSize is {}", read->width,
                                     read->height, light_.face_size));
    const DecodedImage image = widen(std::move(read).value());
    // only now: the size that the light claims is that of an image
    cube.texels.resize(size_t{face + 1} * cube.width * cube.height);
    for (uint32_t y = 0; y < cube.height; ++y)
        for (uint32_t x = 0; x < cube.width; ++x)
        {
            // The extension mirrors the faces of a GPU's cube, each in its place.
            HEARTH_ASSIGN_OR_RETURN(cube.texels[cube.index(face, cube.width - 1 - x, y)],
                                    decodeTexel(face, image, x, y));
        }
    return success();
}

/// Return the radiance of a texel of RGBD: colour divided by alpha. Images without alpha are opaque.
Result<Float3> FaceReader::decodeTexel(uint32_t face, const DecodedImage& image, uint32_t x, uint32_t y) const
{
    constexpr float kMax = std::numeric_limits<uint16_t>::max();
    uint16_t channels[4];
    std::memcpy(channels, image.texels.data() + sizeof(channels) * (size_t{y} * image.width + x),
                sizeof(channels));
    Float3 color;
    for (int c = 0; c < 3; ++c)
        color[c] = linearFromSrgb(static_cast<float>(channels[c]) / kMax);
    if (color == Float3{})
        return color;
    if (channels[3] == 0)
        return faceError(face, Issue::image_unsupported,
                         fmt::format("texel ({}, {}) has a colour but alpha 0, by which RGBD divides", x, y));
    const Float3 radiance = color * (light_.intensity * kMax / static_cast<float>(channels[3]));
    if (!isFinite(radiance))
        return context_.error(
            Issue::number_too_large, where_,
            fmt::format("intensity {:g} makes radiance that does not fit 32-bit numbers", light_.intensity));
    return radiance;
}

std::string nameLight(const GltfModel& model, size_t index)
{
    const std::string& name = model.image_lights[index].name;
    return name.empty() ? fmt::format("image-based light {}", index)
                        : fmt::format("image-based light \"{}\"", name);
}

} // namespace

Status readSky(const GltfModel& model, const GltfBuffers& buffers, const GltfContext& context)
{
    const uint32_t scene = drawnScene(model);
    const uint32_t of_scene = scene == kInvalidIndex ? kInvalidIndex : model.scenes[scene].image_light;
    const auto warn = [&](size_t light, std::string_view reason)
    {
        context.part.warn(Issue::dropped, fmt::format("/extensions/EXT_lights_image_based/lights/{}", light),
                          fmt::format("{}, which {}, is not kept", nameLight(model, light), reason));
    };
    for (size_t light = 0; light < model.image_lights.size(); ++light)
        if (light != of_scene)
            warn(light, "the scene does not have");
    if (of_scene == kInvalidIndex || !context.options.takes_sky)
        return success();
    const GltfImageLight& light = model.image_lights[of_scene];
    HEARTH_ASSIGN_OR_RETURN(Environment cube, FaceReader(model, buffers, context, of_scene).read());
    const auto shines = [](Float3 texel) { return texel.x > 0 || texel.y > 0 || texel.z > 0; };
    if (std::ranges::any_of(cube.texels, shines))
        context.part.sky = SourceSky{std::move(cube), transformFromTrs({0, 0, 0}, light.rotation, {1, 1, 1})};
    else
        warn(of_scene, "is black");
    return success();
}

} // namespace hearth::import
