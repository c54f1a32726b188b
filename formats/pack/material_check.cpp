// Checks materials and images, skins and animations.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/codecs/channel_keys.h"
#include "formats/pack/check_tools.h"
#include "formats/pack/pack_check.h"
#include "formats/pack/texture_pieces.h"
#include "formats/records/animation_paths.h"

#include <bit>

namespace hearth::formats::check
{

namespace
{

/// table, i  record that has the texture: "material 3"
Status checkTexture(const PackView& view, const char* table, size_t i, const char* name,
                    const TextureRef& texture)
{
    const std::string field = std::string(name) + ": ";
    if (!isNoneOrBelow(texture.image, view.images().size()))
        return makeError(view, Issue::meaning_reference, table, i,
                         field + "image " + std::to_string(texture.image));
    const auto last_wrap = static_cast<uint8_t>(Wrap::clamp_to_edge);
    if (texture.uv_set > 3 || texture.wrap_u > last_wrap || texture.wrap_v > last_wrap || texture.nearest > 1)
        return makeError(view, Issue::meaning_value, table, i, field + "its sampler is not possible");
    if (!finite(texture.uv_transform))
        return makeError(view, Issue::meaning_value, table, i, field + "its UV transform is not finite");
    return success();
}

Status checkMaterial(const PackView& view, size_t i)
{
    const MaterialRecord& m = view.materials()[i];
    if ((m.flags & ~uint32_t{kMaterialDoubleSided | kMaterialUnlit}) != 0)
        return makeError(view, Issue::meaning_value, "material", i, "flags " + std::to_string(m.flags));
    if (m.alpha_mode > static_cast<uint32_t>(AlphaMode::blend))
        return makeError(view, Issue::meaning_value, "material", i,
                         "alpha mode " + std::to_string(m.alpha_mode));
    const float factors[] = {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w,
                             m.emissive.x,   m.emissive.y,   m.emissive.z,   m.alpha_cutoff};
    if (!std::all_of(std::begin(factors), std::end(factors), isNonNegative) || !finite(m.normal_scale))
        return makeError(view, Issue::meaning_value, "material", i, "a factor is negative or not finite");
    if (!inside(m.metallic, 0, 1) || !inside(m.roughness, 0, 1) || !inside(m.occlusion_strength, 0, 1))
        return makeError(view, Issue::meaning_value, "material", i, "a factor is not in 0..1");
    HEARTH_TRY(checkTexture(view, "material", i, "base_color_texture", m.base_color_texture));
    HEARTH_TRY(checkTexture(view, "material", i, "metallic_roughness_texture", m.metallic_roughness_texture));
    HEARTH_TRY(checkTexture(view, "material", i, "normal_texture", m.normal_texture));
    HEARTH_TRY(checkTexture(view, "material", i, "occlusion_texture", m.occlusion_texture));
    return checkTexture(view, "material", i, "emissive_texture", m.emissive_texture);
}

Status checkLayers(const PackView& view, size_t i)
{
    const char* const table = "material layers";
    const MaterialLayersRecord& m = view.materialLayers()[i];
    if (m.material >= view.materials().size())
        return makeError(view, Issue::meaning_reference, table, i, "material " + std::to_string(m.material));
    if (i > 0 && view.materialLayers()[i - 1].material >= m.material)
        return makeError(view, Issue::meaning_order, table, i, "the records are not sorted by material");
    if (m.ior != 0 && (!isNonNegative(m.ior) || m.ior < 1))
        return makeError(view, Issue::meaning_value, table, i, "its index of refraction is not possible");
    const float colors[] = {m.specular_color.x, m.specular_color.y, m.specular_color.z};
    if (!std::all_of(std::begin(colors), std::end(colors), isNonNegative) ||
        !finite(m.clearcoat_normal_scale))
        return makeError(view, Issue::meaning_value, table, i, "a factor is negative or not finite");
    for (const float factor : {m.specular, m.clearcoat, m.clearcoat_roughness, m.sheen_color.x,
                               m.sheen_color.y, m.sheen_color.z, m.sheen_roughness})
        if (!inside(factor, 0, 1))
            return makeError(view, Issue::meaning_value, table, i, "a factor is not in 0..1");
    HEARTH_TRY(checkTexture(view, table, i, "specular_texture", m.specular_texture));
    HEARTH_TRY(checkTexture(view, table, i, "clearcoat_texture", m.clearcoat_texture));
    HEARTH_TRY(checkTexture(view, table, i, "clearcoat_normal_texture", m.clearcoat_normal_texture));
    return checkTexture(view, table, i, "sheen_texture", m.sheen_texture);
}

/// Check the fields that encoding fills.
Status checkEncoding(const PackView& view, uint32_t i)
{
    const ImageRecord& image = view.images()[i];
    if (image.role > static_cast<uint8_t>(ImageRole::light))
        return makeError(view, Issue::meaning_value, "image", i, "role " + std::to_string(image.role));
    for (const uint8_t source : image.swizzle)
        if (source > static_cast<uint8_t>(Swizzle::alpha))
            return makeError(view, Issue::meaning_value, "image", i, "swizzle " + std::to_string(source));
    if (!isNonNegative(image.error) || !isNonNegative(image.error_p999) ||
        !isNonNegative(image.error_smooth) || !inside(image.coverage_error, 0, 1))
        return makeError(view, Issue::meaning_value, "image", i, "an error is negative or not finite");
    if (!isNonNegative(image.target) || !isNonNegative(image.target_smooth))
        return makeError(view, Issue::meaning_value, "image", i, "a target is negative or not finite");
    if (!reservedZero(image.reserved_bytes))
        return makeError(view, Issue::meaning_padding, "image", i, "a reserved field is not 0");
    return success();
}

Status checkImage(const PackView& view, uint32_t i, BulkData bulk)
{
    const ImageRecord& image = view.images()[i];
    if (image.width < 1 || image.width > kMaxImageSize || image.height < 1 || image.height > kMaxImageSize)
        return makeError(view, Issue::meaning_value, "image", i,
                         std::to_string(image.width) + " x " + std::to_string(image.height) + " texels");
    const auto full_chain = static_cast<uint32_t>(std::bit_width(std::max(image.width, image.height)));
    if (image.mip_count < 1 || image.mip_count > full_chain)
        return makeError(view, Issue::meaning_value, "image", i, std::to_string(image.mip_count) + " mips");
    if (!isPackFormat(image.format))
        return makeError(view, Issue::meaning_value, "image", i, "format " + std::to_string(image.format));
    if ((image.flags & ~uint32_t{kImagePlaceholder | kImageNormalMap | kImageAlphaTested}) != 0)
        return makeError(view, Issue::meaning_value, "image", i, "flags " + std::to_string(image.flags));
    if (!isNonNegative(image.alpha_cutoff))
        return makeError(view, Issue::meaning_value, "image", i,
                         "its alpha cutoff is negative or not finite");
    HEARTH_TRY(checkEncoding(view, i));

    const ChunkEntry* data = view.container().find(kChunkImageData, i);
    if (data == nullptr)
        return Error{Issue::chunk_missing, view.name(), chunkName(kChunkImageData, i), ""};
    if (data->size != mipOffset(image, image.mip_count))
        return Error{Issue::chunk_size, view.name(), chunkName(kChunkImageData, i),
                     std::to_string(data->size) + " bytes, its image has " +
                         std::to_string(mipOffset(image, image.mip_count))};
    return bulk == BulkData::read ? view.container().checkDecodes(*data) : success();
}

/// Check that the pieces of an image are those of its size and format, and cover its chunk.
Status checkPieces(const PackView& view, uint32_t i)
{
    const ImageRecord& image = view.images()[i];
    const ChunkEntry& data = *view.container().find(kChunkImageData, i);
    const std::vector<TexturePiece> pieces = listTexturePieces(image);
    if (pieces.size() != image.pieces.count)
        return makeError(view, Issue::meaning_range, "image", i,
                         std::to_string(image.pieces.count) + " pieces, its size and format have " +
                             std::to_string(pieces.size()));
    uint64_t offset = 0;
    for (uint32_t k = 0; k < pieces.size(); ++k)
    {
        const TexturePieceRecord& record = view.texturePieces()[image.pieces.first + k];
        if (record.offset != offset || record.size != pieces[k].size)
            return makeError(view, Issue::meaning_value, "texture piece", image.pieces.first + k,
                             "it does not follow the piece before, or has another size");
        offset += record.stored_size;
    }
    if (offset != data.stored_size || data.codec != static_cast<uint32_t>(Codec::zstd_frames))
        return Error{Issue::chunk_size, view.name(), chunkName(kChunkImageData, i),
                     "its pieces do not cover it"};
    return success();
}

/// Check that the images share the table of pieces, in order.
Status checkTexturePieces(const PackView& view)
{
    uint32_t next = 0;
    for (uint32_t i = 0; i < view.images().size(); ++i)
    {
        const Range& pieces = view.images()[i].pieces;
        if (pieces.first != next || !isInsideTable(pieces, view.texturePieces().size()))
            return makeError(view, Issue::meaning_range, "image", i,
                             "its pieces do not follow those of the image before");
        if (pieces.count > 0)
            HEARTH_TRY(checkPieces(view, i));
        next += pieces.count;
    }
    if (next != view.texturePieces().size())
        return Error{Issue::meaning_range, view.name(), chunkName(kChunkTexturePieces, 0),
                     "pieces belong to no image"};
    return success();
}

Status checkJoint(const PackView& view, size_t i)
{
    const JointRecord& joint = view.joints()[i];
    if (joint.node >= view.nodes().size())
        return makeError(view, Issue::meaning_reference, "joint", i, "node " + std::to_string(joint.node));
    if (!finite(joint.joint_from_bind))
        return makeError(view, Issue::meaning_value, "joint", i, "its matrix is not finite");
    if (!reservedZero(joint.reserved))
        return makeError(view, Issue::meaning_padding, "joint", i, "a reserved field is not 0");
    return success();
}

/// Test that the times of a channel never decrease, in constant time for any channel.
class TimeOrderTable
{
public:
    explicit TimeOrderTable(std::span<const float> keys) : steps_back_(keys.size() + 1, 0)
    {
        for (size_t i = 1; i < keys.size(); ++i)
            steps_back_[i + 1] = steps_back_[i] + (keys[i] < keys[i - 1] ? 1 : 0);
    }
    bool isAscending(uint32_t first, uint32_t count) const
    {
        return count == 0 || steps_back_[size_t{first} + 1] == steps_back_[size_t{first} + count];
    }

private:
    /// [i + 1]: number of keys up to and including i that are less than the key before them
    std::vector<uint32_t> steps_back_;
};

bool isSpline(const AnimationChannelRecord& channel)
{
    return channel.interpolation == static_cast<uint32_t>(Interpolation::cubic_spline);
}

Status checkFloatKeys(const PackView& view, size_t i)
{
    const AnimationChannelRecord& channel = view.channels()[i];
    const size_t size = view.keys().size();
    const uint64_t floats =
        uint64_t{channel.components} * (isSpline(channel) ? 3 : 1); // of one key: below 2^34
    if (!isInsideTable({channel.first_time, channel.key_count}, size) || channel.first_value > size ||
        floats > (size - channel.first_value) / channel.key_count)
        return makeError(view, Issue::meaning_range, "channel", i, "its keys lie outside chunk AKEY");
    if (channel.first_word != 0 || channel.time_bits != 0 || channel.value_bits[0] != 0 ||
        channel.value_bits[1] != 0 || channel.value_bits[2] != 0)
        return makeError(view, Issue::meaning_padding, "channel", i, "a field of packed keys is not 0");
    return success();
}

/// Check the packed keys of a channel.
/// next_word  end of the streams of earlier channels; moved to the end of this channel's streams
Status checkPackedKeys(const PackView& view, size_t i, uint64_t& next_word)
{
    const AnimationChannelRecord& channel = view.channels()[i];
    if (isSpline(channel) || channel.path >= static_cast<uint32_t>(AnimationPath::weights))
        return makeError(view, Issue::meaning_value, "channel", i,
                         "splines, morph weights and lights cannot be packed");
    const auto tooWide = [](uint8_t bits) { return bits > kMaxKeyFieldBits; };
    if (std::any_of(std::begin(channel.value_bits), std::end(channel.value_bits), tooWide) ||
        tooWide(channel.time_bits))
        return makeError(view, Issue::meaning_value, "channel", i,
                         "a code of its keys has more than 24 bits");
    // each stream after the one before: this bounds the checking time by the size of the chunk
    if (channel.first_word < next_word)
        return makeError(view, Issue::meaning_order, "channel", i,
                         "its packed keys are not behind those before");
    const uint64_t words = (uint64_t{channel.key_count} * keyStride(channel) + 31) / 32;
    if (channel.first_word > view.keyBits().size() || words > view.keyBits().size() - channel.first_word)
        return makeError(view, Issue::meaning_range, "channel", i, "its keys lie outside chunk AKBT");
    next_word = channel.first_word + words;

    const size_t size = view.keys().size();
    if (!isInsideTable({channel.first_value, 4}, size) ||
        !isInsideTable({channel.first_time, channel.time_bits == 0 ? channel.key_count : 1}, size))
        return makeError(view, Issue::meaning_range, "channel", i, "its keys lie outside chunk AKEY");
    if (view.keys()[size_t{channel.first_value} + 3] < 0)
        return makeError(view, Issue::meaning_value, "channel", i, "the step of its codes is negative");
    const auto stream = view.keyBits().subspan(channel.first_word);
    for (uint32_t key = 0; key < channel.key_count && channel.time_bits > 0; ++key)
        if (readBits(stream, uint64_t{key} * keyStride(channel), channel.time_bits) >=
            size - channel.first_time)
            return makeError(view, Issue::meaning_range, "channel", i,
                             "the time of key " + std::to_string(key) + " lies outside chunk AKEY");
    return success();
}

/// Check the times of keys that are inside their chunks.
Status checkTimes(const PackView& view, const TimeOrderTable& order, size_t i)
{
    const AnimationChannelRecord& channel = view.channels()[i];
    const ChannelKeys keys(view.keys(), view.keyBits(), channel);
    bool isAscending = keys.time(0) >= 0;
    if (channel.time_bits == 0)
        isAscending = isAscending && order.isAscending(channel.first_time, channel.key_count);
    else
        for (uint32_t key = 1; key < keys.count() && isAscending; ++key)
            isAscending = keys.time(key) >= keys.time(key - 1);
    if (!isAscending)
        return makeError(view, Issue::meaning_order, "channel", i, "its times decrease or are negative");
    return success();
}

/// Check path, target and number of components of a channel.
/// of_light  whether the channel belongs to the channels of lights
Status checkPath(const PackView& view, size_t i, bool of_light)
{
    const AnimationChannelRecord& channel = view.channels()[i];
    if (channel.path >= kAnimationPaths.size() || kAnimationPaths[channel.path].of_light != of_light)
        return makeError(view, Issue::meaning_value, "channel", i, "path " + std::to_string(channel.path));
    if (channel.target >= (of_light ? view.lights().size() : view.nodes().size()))
        return makeError(view, Issue::meaning_reference, "channel", i,
                         (of_light ? "light " : "node ") + std::to_string(channel.target));
    const uint32_t expected = kAnimationPaths[channel.path].components;
    if (expected == 0 ? channel.components == 0 : channel.components != expected)
        return makeError(view, Issue::meaning_value, "channel", i,
                         std::to_string(channel.components) + " components");
    return success();
}

/// Check the keys of a light's channel, which are inside their chunk. Tangents may have any value.
Status checkLightValues(const PackView& view, size_t i)
{
    const AnimationChannelRecord& channel = view.channels()[i];
    const auto path = static_cast<AnimationPath>(channel.path);
    const bool cone = path == AnimationPath::light_inner_cone || path == AnimationPath::light_outer_cone;
    const bool range = path == AnimationPath::light_range;
    const ChannelKeys keys(view.keys(), view.keyBits(), channel);
    for (uint32_t key = 0; key < keys.count(); ++key)
        for (const double value : keys.value(key, 0, channel.components))
            if (value < 0 || (cone && value > double{kRightAngle}))
                return makeError(view, Issue::meaning_value, "channel", i,
                                 "key " + std::to_string(key) + " is not possible");
    for (uint32_t key = 0; range && key < keys.count(); ++key)
        if (!(keys.value(key, 0, 1)[0] > 0))
            return makeError(view, Issue::meaning_value, "channel", i,
                             "the range of key " + std::to_string(key) + " is 0");
    return success();
}

/// Check a channel.
/// next_word  as for checkPackedKeys
/// of_light   as for checkPath
Status checkChannel(const PackView& view, const TimeOrderTable& order, size_t i, bool of_light,
                    uint64_t& next_word)
{
    const AnimationChannelRecord& channel = view.channels()[i];
    HEARTH_TRY(checkPath(view, i, of_light));
    if (channel.interpolation > static_cast<uint32_t>(Interpolation::cubic_spline) ||
        channel.encoding > static_cast<uint32_t>(KeyEncoding::packed))
        return makeError(view, Issue::meaning_value, "channel", i,
                         "its interpolation or encoding does not exist");
    if (channel.key_count == 0)
        return makeError(view, Issue::meaning_value, "channel", i, "it has no keys");

    HEARTH_TRY(isPacked(channel) ? checkPackedKeys(view, i, next_word) : checkFloatKeys(view, i));
    HEARTH_TRY(checkTimes(view, order, i));
    return of_light ? checkLightValues(view, i) : success();
}

/// Check the channels of an animation, which lie inside their table.
/// next_word  as for checkPackedKeys
Status checkChannels(const PackView& view, const TimeOrderTable& order, const AnimationRecord& animation,
                     uint64_t& next_word)
{
    for (uint32_t i = 0; i < animation.channels.count; ++i)
        HEARTH_TRY(checkChannel(view, order, animation.channels.first + i, false, next_word));
    for (uint32_t i = 0; i < animation.light_channels.count; ++i)
        HEARTH_TRY(checkChannel(view, order, animation.light_channels.first + i, true, next_word));
    return success();
}

/// Check an animation. A clip may continue after its last key: a node at rest needs no keys.
Status checkAnimation(const PackView& view, size_t i)
{
    const AnimationRecord& animation = view.animations()[i];
    float last = 0;
    for (const Range channels : {animation.channels, animation.light_channels})
        for (const AnimationChannelRecord& channel : recordsInRange(view.channels(), channels))
            last =
                std::max(last, ChannelKeys(view.keys(), view.keyBits(), channel).time(channel.key_count - 1));
    if (!finite(animation.duration) || animation.duration < last)
        return makeError(view, Issue::meaning_value, "animation", i,
                         "duration " + std::to_string(animation.duration) + ", its last key is at " +
                             std::to_string(last));
    if (!isNonNegative(animation.error))
        return makeError(view, Issue::meaning_value, "animation", i, "its error is negative or not finite");
    return success();
}

} // namespace

Status checkMaterials(const PackView& view)
{
    for (size_t i = 0; i < view.materials().size(); ++i)
        HEARTH_TRY(checkMaterial(view, i));
    for (size_t i = 0; i < view.materialLayers().size(); ++i)
        HEARTH_TRY(checkLayers(view, i));
    return success();
}

Status checkImages(const PackView& view, BulkData bulk)
{
    for (uint32_t i = 0; i < view.images().size(); ++i)
        HEARTH_TRY(checkImage(view, i, bulk));
    return checkTexturePieces(view);
}

Status checkSkins(const PackView& view)
{
    for (size_t i = 0; i < view.skins().size(); ++i)
    {
        const SkinRecord& skin = view.skins()[i];
        if (!isNoneOrBelow(skin.skeleton_root, view.nodes().size()))
            return makeError(view, Issue::meaning_reference, "skin", i,
                             "root " + std::to_string(skin.skeleton_root));
        if (!isInsideTable(skin.joints, view.joints().size()))
            return makeError(view, Issue::meaning_range, "skin", i, "its joints lie outside chunk JOIN");
        if (skin.reserved != 0)
            return makeError(view, Issue::meaning_padding, "skin", i, "a reserved field is not 0");
    }
    for (size_t i = 0; i < view.joints().size(); ++i)
        HEARTH_TRY(checkJoint(view, i));
    return success();
}

Status checkAnimations(const PackView& view)
{
    if (!finite(view.keys()))
        return Error{Issue::meaning_value, view.name(), chunkName(kChunkKeys, 0), "a key is not finite"};
    RangeCursor channels(view, "animation", "channel", view.channels().size());
    for (size_t i = 0; i < view.animations().size(); ++i)
    {
        HEARTH_TRY(channels.take(i, view.animations()[i].channels));
        HEARTH_TRY(channels.take(i, view.animations()[i].light_channels));
    }
    HEARTH_TRY(channels.finish());

    const TimeOrderTable order(view.keys());
    uint64_t next_word = 0;
    for (const AnimationRecord& animation : view.animations())
        HEARTH_TRY(checkChannels(view, order, animation, next_word));
    for (size_t i = 0; i < view.animations().size(); ++i)
        HEARTH_TRY(checkAnimation(view, i));
    return success();
}

} // namespace hearth::formats::check
