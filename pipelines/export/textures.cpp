// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/textures.h"

#include "pipelines/export/accessors.h"
#include "pipelines/export/picture.h"

#include <algorithm>
#include <cmath>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

// OpenGL's numbers
constexpr int kNearest = 9728, kLinear = 9729, kNearestMipmapLinear = 9986, kLinearMipmapLinear = 9987;

int wrapNumber(uint8_t wrap)
{
    switch (static_cast<Wrap>(wrap))
    {
    case Wrap::mirrored_repeat:
        return 33648;
    case Wrap::clamp_to_edge:
        return 33071;
    default:
        return 10497;
    }
}

bool isIdentity(const float (&m)[6])
{
    constexpr float kIdentity[] = {1, 0, 0, 0, 1, 0};
    return std::equal(std::begin(m), std::end(m), std::begin(kIdentity));
}

/// Split the matrix of a texture transform, [[c sx, s sy], [-s sx, c sy]], into rotation and scale.
TextureTransform splitTransform(const float (&m)[6])
{
    const double a = double{m[0]}, b = double{m[1]}, c = double{m[3]}, d = double{m[4]};
    TextureTransform transform;
    transform.offset = {double{m[2]}, double{m[5]}};
    // without a turn the numbers stay what they are
    if (b == 0 && c == 0)
    {
        transform.scale = {a, d};
        return transform;
    }
    transform.rotation = a != 0 || c != 0 ? std::atan2(-c, a) : std::atan2(b, d);
    const double cosine = std::cos(transform.rotation), sine = std::sin(transform.rotation);
    transform.scale = {a * cosine - c * sine, b * sine + d * cosine};
    return transform;
}

/// True if rotation and scale do not give the matrix, but for rounding.
bool isSheared(const float (&m)[6], const TextureTransform& transform)
{
    const double cosine = std::cos(transform.rotation), sine = std::sin(transform.rotation);
    const double b = sine * transform.scale[1], d = cosine * transform.scale[1];
    const double size = std::abs(double{m[1]}) + std::abs(double{m[4]});
    constexpr double kRounding = 1e-5;
    return std::abs(b - double{m[1]}) + std::abs(d - double{m[4]}) > kRounding * size;
}

} // namespace

Result<uint32_t> TextureSet::addImage(uint32_t image)
{
    if (const auto found = images_.find(image); found != images_.end())
        return found->second;
    const ImageRecord& record = pack_.images()[image];
    HEARTH_ASSIGN_OR_RETURN(const ChunkData data, pack_.imageData(image));
    const std::vector<std::byte> png = encodeImage(record, data.bytes());
    if (findTexelFormat(record.format)->coding == TexelCoding::float_value)
        omissions_.add("textures of unlimited light, clamped to 1 and 8 bits");
    if ((record.flags & kImagePlaceholder) != 0)
        omissions_.add("textures that stand in for a missing image");
    document_.images.push_back(
        {std::string(pack_.text(record.name)), addView(document_, png, ViewTarget::none)});
    const auto index = static_cast<uint32_t>(document_.images.size() - 1);
    images_.emplace(image, index);
    return index;
}

Result<TextureUse> TextureSet::use(const TextureRef& reference)
{
    TextureUse use;
    if (reference.image == kInvalidIndex)
        return use;
    Texture texture;
    HEARTH_ASSIGN_OR_RETURN(texture.image, addImage(reference.image));
    texture.mag_filter = reference.nearest != 0 ? kNearest : kLinear;
    texture.min_filter = reference.nearest != 0 ? kNearestMipmapLinear : kLinearMipmapLinear;
    texture.wrap_s = wrapNumber(reference.wrap_u);
    texture.wrap_t = wrapNumber(reference.wrap_v);
    auto& textures = document_.textures;
    auto found = std::find(textures.begin(), textures.end(), texture);
    if (found == textures.end())
        found = textures.insert(found, texture);
    use.texture = static_cast<uint32_t>(found - textures.begin());
    use.uv_set = reference.uv_set;
    if (!isIdentity(reference.uv_transform))
    {
        use.transform = splitTransform(reference.uv_transform);
        if (isSheared(reference.uv_transform, *use.transform))
            omissions_.add("texture transforms with shear, written without");
    }
    return use;
}

} // namespace hearth::gltf_export
