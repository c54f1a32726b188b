// Chunks of the scene: nodes, instances, cameras, punctual lights, shadow spheres, materials, images, skins
// and animations.
// Units: metres, radians, candela / lux, linear Rec.709; right-handed, +Y up. See FORMAT.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/record_values.h"
#include "formats/records/container.h"
#include "formats/records/texel_format.h"

#include <bit>

namespace hearth::formats
{

inline constexpr uint32_t kChunkMeta = fourCC("META");          ///< provenance and import report, JSON text
inline constexpr uint32_t kChunkStrings = fourCC("STRS");       ///< string table, bytes
inline constexpr uint32_t kChunkNodes = fourCC("NODE");         ///< NodeRecord[]
inline constexpr uint32_t kChunkInstances = fourCC("INST");     ///< InstanceRecord[]
inline constexpr uint32_t kChunkCameras = fourCC("CAMR");       ///< CameraRecord[]
inline constexpr uint32_t kChunkLights = fourCC("LGHT");        ///< LightRecord[]
inline constexpr uint32_t kChunkShadowSpheres = fourCC("SHSP"); ///< ShadowSphereRecord[]
inline constexpr uint32_t kChunkMaterials = fourCC("MATL");     ///< MaterialRecord[]
inline constexpr uint32_t kChunkImages = fourCC("IMGR");        ///< ImageRecord[]
inline constexpr uint32_t kChunkTexturePieces = fourCC("TXPG"); ///< TexturePieceRecord[]
inline constexpr uint32_t kChunkImageData = fourCC("IMGD");     ///< texels of image `index`, finest mip first
inline constexpr uint32_t kChunkSkins = fourCC("SKIN");         ///< SkinRecord[]
inline constexpr uint32_t kChunkJoints = fourCC("JOIN");        ///< JointRecord[]
inline constexpr uint32_t kChunkAnimations = fourCC("ANIM");    ///< AnimationRecord[]
inline constexpr uint32_t kChunkChannels = fourCC("ACHN");      ///< AnimationChannelRecord[]
inline constexpr uint32_t kChunkKeys = fourCC("AKEY");          ///< f32[]: times and values of all channels
inline constexpr uint32_t kChunkKeyBits = fourCC("AKBT");       ///< u32[]: packed keys
inline constexpr uint32_t kChunkMorphWeights = fourCC("MWGT");  ///< f32[]: rest weights of morph targets

/// Nodes keep their order and index of the source. A parent may come after its child; there are no cycles.
struct NodeRecord
{
    StringRef name;
    uint32_t parent;
    uint32_t mesh;
    uint32_t skin;
    uint32_t has_trs;
    Float3 translation;
    Float4 rotation;
    Float3 scale;
    Affine3 parent_from_node;
    Range morph_weights;
};

using shared::kInstanceMirrored; // a bit of InstanceRecord::flags

/// Drawn copy of a mesh in the rest pose.
struct InstanceRecord
{
    Affine3 world_from_object;
    uint32_t mesh;
    uint32_t node;
    uint32_t flags;
    float scale_max;
};

enum class CameraType : uint32_t
{
    perspective = 0,
    orthographic = 1,
};

struct CameraRecord
{
    StringRef name;
    uint32_t type;
    uint32_t node;
    float y_fov_rad;
    float aspect;
    float x_magnification;
    float y_magnification;
    float z_near;
    float z_far;
    Affine3 world_from_camera;
};

enum class LightType : uint32_t
{
    directional = shared::kLightDirectional,
    point = shared::kLightPoint,
    spot = shared::kLightSpot,
};

/// Punctual light, as in KHR_lights_punctual. It shines along its local -Z. Its flicker:
/// formats/scene/light_flicker.h.
struct LightRecord
{
    StringRef name;
    uint32_t type;
    uint32_t node;
    Float3 color;
    float intensity;
    float range;
    float inner_cone_rad;
    float outer_cone_rad;
    float flicker_rate;
    float flicker_amplitude;
    uint32_t flicker_seed;
    Affine3 world_from_light;
};

/// Part of the scene with sharp shadows: it gets a shadow map of its own, fitted to the sphere.
struct ShadowSphereRecord
{
    uint32_t node;
    uint32_t light;
    Float3 center;
    float radius;
    uint32_t texels;
    uint32_t reserved;
};

/// Size in texels each way of a shadow sphere's map, a power of two.
inline constexpr uint32_t kMinShadowTexels = 64;
inline constexpr uint32_t kMaxShadowTexels = 8192;

constexpr bool isShadowMapSize(uint64_t texels)
{
    return std::has_single_bit(texels) && texels >= kMinShadowTexels && texels <= kMaxShadowTexels;
}

enum class Wrap : uint8_t
{
    repeat = 0,
    mirrored_repeat = 1,
    clamp_to_edge = 2,
};

struct TextureRef
{
    static constexpr std::string_view kTypeName = "TextureRef";
    uint32_t image;
    uint8_t uv_set;
    uint8_t wrap_u;
    uint8_t wrap_v;
    uint8_t nearest;
    float uv_transform[6];
};

enum class AlphaMode : uint32_t
{
    opaque = shared::kAlphaOpaque,
    mask = shared::kAlphaMask,
    blend = shared::kAlphaBlend,
};

// bits of MaterialRecord::flags
using shared::kMaterialDoubleSided;
using shared::kMaterialUnlit;

/// Metallic-roughness material of glTF 2.0.
struct MaterialRecord
{
    StringRef name;
    uint32_t flags;
    uint32_t alpha_mode;
    Float4 base_color;
    Float3 emissive;
    float alpha_cutoff;
    float metallic;
    float roughness;
    float normal_scale;
    float occlusion_strength;
    TextureRef base_color_texture;
    TextureRef metallic_roughness_texture;
    TextureRef normal_texture;
    TextureRef occlusion_texture;
    TextureRef emissive_texture;
};

enum ImageFlags : uint32_t
{
    kImagePlaceholder = 1, ///< replaces an image that was missing or could not be decoded
    kImageNormalMap = 2,   ///< mips are averaged as directions
    kImageAlphaTested = 4, ///< mips keep the covered area at the alpha cutoff
};

/// Textures of a material.
inline constexpr TextureRef MaterialRecord::*kMaterialTextureFields[] = {
    &MaterialRecord::base_color_texture, &MaterialRecord::metallic_roughness_texture,
    &MaterialRecord::normal_texture, &MaterialRecord::occlusion_texture, &MaterialRecord::emissive_texture};

/// Use of an image by materials, which decides how its loss is measured.
enum class ImageRole : uint8_t
{
    none = 0,     ///< parts of import only
    color = 1,    ///< sRGB colour; alpha, if it is read, is another number
    cutout = 2,   ///< sRGB colour of which alpha is the opacity
    emissive = 3, ///< sRGB colour of light
    data = 4,     ///< independent numbers: occlusion, roughness, metalness
    normal = 5,   ///< x and y of directions
    light = 6,    ///< linear light without an upper limit
};

/// Source of a channel that a shader reads. Values are those of VkComponentSwizzle.
enum class Swizzle : uint8_t
{
    identity = 0, ///< the stored channel of the same name
    zero = 1,
    one = 2,
    red = 3,
    green = 4,
    blue = 5,
    alpha = 6,
};

/// Image. Mip i is max(1, size >> i), each mip follows the finer one. Rows of blocks from top to bottom,
/// tightly packed; blocks that reach over the edge are whole.
struct ImageRecord
{
    StringRef name;
    uint32_t width;
    uint32_t height;
    uint32_t mip_count;
    uint32_t format;
    uint32_t flags;
    float alpha_cutoff;
    uint8_t role;
    uint8_t reserved_bytes[3];
    uint8_t swizzle[4];
    float error;
    float error_p999;
    float error_smooth;
    float coverage_error;
    float target;
    float target_smooth;
    Range pieces; ///< none: the texels are read as a whole
};

/// Piece of an image's texels: a zstd frame of the image's chunk. Its place in the image follows from the
/// image's size and format: see formats/pack/texture_pieces.h.
struct TexturePieceRecord
{
    uint64_t offset;
    uint32_t stored_size;
    uint32_t size;
    uint64_t hash;
};

struct SkinRecord
{
    StringRef name;
    uint32_t skeleton_root;
    Range joints;
    uint32_t reserved;
};

struct JointRecord
{
    uint32_t node;
    uint32_t reserved[3];
    Affine3 joint_from_bind;
};

struct AnimationRecord
{
    StringRef name;
    Range channels;
    Range light_channels;
    float duration;
    float error;
};

enum class AnimationPath : uint32_t
{
    translation = 0,
    rotation = 1,
    scale = 2,
    weights = 3,
    light_color = 4,
    light_intensity = 5,
    light_range = 6,
    light_inner_cone = 7,
    light_outer_cone = 8,
};

enum class Interpolation : uint32_t
{
    step = 0,
    linear = 1,
    cubic_spline = 2,
};

enum class KeyEncoding : uint32_t
{
    floats = 0,
    packed = 1,
};

/// Maximum number of bits of a packed key field: more bits than a float's mantissa gain nothing.
inline constexpr uint32_t kMaxKeyFieldBits = 24;

/// Channel of an animation. Floats: key_count times, and key_count * components values, times three
/// (in-tangent, value, out-tangent) for a cubic spline. Packed: see FORMAT.md. formats/codecs/channel_keys.h
/// reads both. formats/records/animation_paths.h lists what channels animate.
struct AnimationChannelRecord
{
    uint32_t target;
    uint32_t path;
    uint32_t interpolation;
    uint32_t components;
    uint32_t key_count;
    uint32_t first_time;
    uint32_t first_value;
    uint32_t encoding;
    uint32_t first_word;
    uint8_t value_bits[3];
    uint8_t time_bits;
};

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::NodeRecord, 120,
              HEARTH_FIELD(hearth::formats::NodeRecord, name, "may be empty"),
              HEARTH_FIELD(hearth::formats::NodeRecord, parent, "node, or none for a root"),
              HEARTH_FIELD(hearth::formats::NodeRecord, mesh, "mesh, or none"),
              HEARTH_FIELD(hearth::formats::NodeRecord, skin, "skin, or none"),
              HEARTH_FIELD(hearth::formats::NodeRecord, has_trs,
                           "1: the next three fields hold; 0: only the matrix"),
              HEARTH_FIELD(hearth::formats::NodeRecord, translation, "metres"),
              HEARTH_FIELD(hearth::formats::NodeRecord, rotation, "unit quaternion x y z w"),
              HEARTH_FIELD(hearth::formats::NodeRecord, scale, ""),
              HEARTH_FIELD(hearth::formats::NodeRecord, parent_from_node, "row-major 3x4"),
              HEARTH_FIELD(hearth::formats::NodeRecord, morph_weights,
                           "floats of chunk MWGT, one for each target of the mesh"));
HEARTH_RECORD(hearth::formats::InstanceRecord, 64,
              HEARTH_FIELD(hearth::formats::InstanceRecord, world_from_object, "row-major 3x4, rest pose"),
              HEARTH_FIELD(hearth::formats::InstanceRecord, mesh, "mesh"),
              HEARTH_FIELD(hearth::formats::InstanceRecord, node, "node it came from"),
              HEARTH_FIELD(hearth::formats::InstanceRecord, flags, "1 mirrored"),
              HEARTH_FIELD(hearth::formats::InstanceRecord, scale_max,
                           "at least the largest singular value of world_from_object"));
HEARTH_RECORD(
    hearth::formats::CameraRecord, 88, HEARTH_FIELD(hearth::formats::CameraRecord, name, "may be empty"),
    HEARTH_FIELD(hearth::formats::CameraRecord, type, "0 perspective, 1 orthographic"),
    HEARTH_FIELD(hearth::formats::CameraRecord, node, "node it came from"),
    HEARTH_FIELD(hearth::formats::CameraRecord, y_fov_rad, "full vertical angle; 0 if orthographic"),
    HEARTH_FIELD(hearth::formats::CameraRecord, aspect, "width / height; 0: that of the window"),
    HEARTH_FIELD(hearth::formats::CameraRecord, x_magnification, "half width in metres if orthographic"),
    HEARTH_FIELD(hearth::formats::CameraRecord, y_magnification, "half height in metres if orthographic"),
    HEARTH_FIELD(hearth::formats::CameraRecord, z_near, "metres"),
    HEARTH_FIELD(hearth::formats::CameraRecord, z_far, "metres; 0: infinite"),
    HEARTH_FIELD(hearth::formats::CameraRecord, world_from_camera, "row-major 3x4; looks along -Z"));
HEARTH_RECORD(hearth::formats::LightRecord, 104,
              HEARTH_FIELD(hearth::formats::LightRecord, name, "may be empty"),
              HEARTH_FIELD(hearth::formats::LightRecord, type, "0 directional, 1 point, 2 spot"),
              HEARTH_FIELD(hearth::formats::LightRecord, node, "node it came from"),
              HEARTH_FIELD(hearth::formats::LightRecord, color, "linear Rec.709"),
              HEARTH_FIELD(hearth::formats::LightRecord, intensity, "lux if directional, else candela"),
              HEARTH_FIELD(hearth::formats::LightRecord, range, "metres; 0: unlimited"),
              HEARTH_FIELD(hearth::formats::LightRecord, inner_cone_rad, "half-angle"),
              HEARTH_FIELD(hearth::formats::LightRecord, outer_cone_rad, "half-angle"),
              HEARTH_FIELD(hearth::formats::LightRecord, flicker_rate, "hertz; 0: the light is steady"),
              HEARTH_FIELD(hearth::formats::LightRecord, flicker_amplitude, "0 to 1, share of the intensity"),
              HEARTH_FIELD(hearth::formats::LightRecord, flicker_seed, "of the noise"),
              HEARTH_FIELD(hearth::formats::LightRecord, world_from_light, "row-major 3x4; shines along -Z"));
HEARTH_RECORD(hearth::formats::ShadowSphereRecord, 32,
              HEARTH_FIELD(hearth::formats::ShadowSphereRecord, node, "node it came from"),
              HEARTH_FIELD(hearth::formats::ShadowSphereRecord, light, "light, or none: all lights"),
              HEARTH_FIELD(hearth::formats::ShadowSphereRecord, center, "world"),
              HEARTH_FIELD(hearth::formats::ShadowSphereRecord, radius, "metres, above 0"),
              HEARTH_FIELD(hearth::formats::ShadowSphereRecord, texels,
                           "of its map each way, a power of two from 64 to 8192; 0: the renderer's choice"),
              HEARTH_FIELD(hearth::formats::ShadowSphereRecord, reserved, "0"));
HEARTH_RECORD(hearth::formats::TextureRef, 32,
              HEARTH_FIELD(hearth::formats::TextureRef, image, "image, or none"),
              HEARTH_FIELD(hearth::formats::TextureRef, uv_set, "0 to 3"),
              HEARTH_FIELD(hearth::formats::TextureRef, wrap_u,
                           "0 repeat, 1 mirrored repeat, 2 clamp to edge"),
              HEARTH_FIELD(hearth::formats::TextureRef, wrap_v, "the same"),
              HEARTH_FIELD(hearth::formats::TextureRef, nearest, "1: magnified without filtering"),
              HEARTH_FIELD(hearth::formats::TextureRef, uv_transform, "row-major 2x3, applied to (u, v, 1)"));
HEARTH_RECORD(
    hearth::formats::MaterialRecord, 224, HEARTH_FIELD(hearth::formats::MaterialRecord, name, "may be empty"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, flags, "1 double-sided, 2 unlit"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, alpha_mode, "0 opaque, 1 mask, 2 blend"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, base_color, "linear RGBA factor"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, emissive, "linear factor times emissive strength"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, alpha_cutoff, "used by mode mask"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, metallic, "factor 0..1"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, roughness, "factor 0..1"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, normal_scale, ""),
    HEARTH_FIELD(hearth::formats::MaterialRecord, occlusion_strength, "0..1"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, base_color_texture, ""),
    HEARTH_FIELD(hearth::formats::MaterialRecord, metallic_roughness_texture, "G roughness, B metallic"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, normal_texture, "tangent space, +Y up"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, occlusion_texture, "R"),
    HEARTH_FIELD(hearth::formats::MaterialRecord, emissive_texture, ""));
HEARTH_RECORD(
    hearth::formats::ImageRecord, 72,
    HEARTH_FIELD(hearth::formats::ImageRecord, name, "file name or name in the source"),
    HEARTH_FIELD(hearth::formats::ImageRecord, width, "texels"),
    HEARTH_FIELD(hearth::formats::ImageRecord, height, "texels"),
    HEARTH_FIELD(hearth::formats::ImageRecord, mip_count, ""),
    HEARTH_FIELD(hearth::formats::ImageRecord, format, "as in the table of texel formats"),
    HEARTH_FIELD(hearth::formats::ImageRecord, flags, "1 placeholder, 2 normal map, 4 alpha-tested"),
    HEARTH_FIELD(hearth::formats::ImageRecord, alpha_cutoff, "that the mips keep the coverage of"),
    HEARTH_FIELD(hearth::formats::ImageRecord, role,
                 "0 none, 1 color, 2 cutout, 3 emissive, 4 data, 5 normal, 6 light"),
    HEARTH_FIELD(hearth::formats::ImageRecord, reserved_bytes, "0"),
    HEARTH_FIELD(hearth::formats::ImageRecord, swizzle,
                 "source of red to alpha: 0 the same channel, 1 zero, 2 one, 3 to 6 stored red to alpha"),
    HEARTH_FIELD(hearth::formats::ImageRecord, error,
                 "RMS loss of encoding over mips 0 to 3: share of the range; normals: radians; light: stops"),
    HEARTH_FIELD(hearth::formats::ImageRecord, error_p999,
                 "loss that 99.9 % of the texels of mip 0 do not exceed"),
    HEARTH_FIELD(hearth::formats::ImageRecord, error_smooth, "as error, of smooth areas; 0: there are few"),
    HEARTH_FIELD(hearth::formats::ImageRecord, coverage_error,
                 "largest change of the share of texels that pass the alpha test, of a mip of 0 to 3"),
    HEARTH_FIELD(hearth::formats::ImageRecord, target,
                 "bound that the format was chosen by: error should not exceed it; 0: none was set"),
    HEARTH_FIELD(hearth::formats::ImageRecord, target_smooth, "the same of error_smooth"),
    HEARTH_FIELD(hearth::formats::ImageRecord, pieces, "records of chunk TXPG, or none"));
HEARTH_RECORD(hearth::formats::TexturePieceRecord, 24,
              HEARTH_FIELD(hearth::formats::TexturePieceRecord, offset, "in the image's chunk IMGD"),
              HEARTH_FIELD(hearth::formats::TexturePieceRecord, stored_size, "bytes"),
              HEARTH_FIELD(hearth::formats::TexturePieceRecord, size, "bytes of texels"),
              HEARTH_FIELD(hearth::formats::TexturePieceRecord, hash, "XXH3 of the stored bytes"));
HEARTH_RECORD(hearth::formats::SkinRecord, 24,
              HEARTH_FIELD(hearth::formats::SkinRecord, name, "may be empty"),
              HEARTH_FIELD(hearth::formats::SkinRecord, skeleton_root, "node, or none"),
              HEARTH_FIELD(hearth::formats::SkinRecord, joints, "records of chunk JOIN"),
              HEARTH_FIELD(hearth::formats::SkinRecord, reserved, "0"));
HEARTH_RECORD(hearth::formats::JointRecord, 64, HEARTH_FIELD(hearth::formats::JointRecord, node, "node"),
              HEARTH_FIELD(hearth::formats::JointRecord, reserved, "0"),
              HEARTH_FIELD(hearth::formats::JointRecord, joint_from_bind,
                           "inverse bind matrix, row-major 3x4"));
HEARTH_RECORD(
    hearth::formats::AnimationRecord, 32,
    HEARTH_FIELD(hearth::formats::AnimationRecord, name, "may be empty"),
    HEARTH_FIELD(hearth::formats::AnimationRecord, channels, "records of chunk ACHN, of nodes"),
    HEARTH_FIELD(hearth::formats::AnimationRecord, light_channels,
                 "records of chunk ACHN, of lights, right after those of nodes"),
    HEARTH_FIELD(hearth::formats::AnimationRecord, duration,
                 "seconds: not before the last key of all channels"),
    HEARTH_FIELD(hearth::formats::AnimationRecord, error,
                 "metres in the world: how far a vertex may be from where the source's clip takes it"));
HEARTH_RECORD(
    hearth::formats::AnimationChannelRecord, 40,
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, target, "node, or light"),
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, path,
                 "0 translation, 1 rotation, 2 scale, 3 morph weights, 4 to 8 property of a light"),
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, interpolation, "0 step, 1 linear, 2 cubic spline"),
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, components, "floats of one value"),
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, key_count, ""),
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, first_time,
                 "float of chunk AKEY; key_count times, or the table of packed times"),
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, first_value,
                 "float of chunk AKEY; packed: x, y, z of the code 0, and the step of codes"),
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, encoding, "0 floats, 1 packed"),
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, first_word, "packed: word of chunk AKBT; else 0"),
    HEARTH_FIELD(hearth::formats::AnimationChannelRecord, value_bits,
                 "packed: bits of the codes of x, y, z, at most 24; else 0"),
    HEARTH_FIELD(
        hearth::formats::AnimationChannelRecord, time_bits,
        "packed: bits of a key's place in the table of times, at most 24; 0: they follow each other"));
