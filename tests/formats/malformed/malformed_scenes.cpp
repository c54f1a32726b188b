// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/malformed/malformed_packs.h"

#include <limits>

namespace hearth::test
{

using namespace formats;

namespace
{

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr uint32_t kHuge = 0xFFFFFFF0u; ///< first + count overflows 32 bits

} // namespace

const std::vector<MalformedPack>& malformedScenes()
{
    static const std::vector<MalformedPack> cases = {
        {"metaNotUtf8", Issue::meaning_text, "chunk META 0", [](PackModel& p) { p.meta[2] = '\xFF'; }},
        {"stringsSurrogate", Issue::meaning_text, "chunk STRS 0",
         [](PackModel& p) { p.strings += "\xED\xA0\x80"; }},
        {"stringsOverlong", Issue::meaning_text, "chunk STRS 0",
         [](PackModel& p) { p.strings += "\xC0\x80"; }},
        {"stringsOverlongThree", Issue::meaning_text, "chunk STRS 0",
         [](PackModel& p) { p.strings += "\xE0\x80\x80"; }},
        {"stringsBeyondUnicode", Issue::meaning_text, "chunk STRS 0",
         [](PackModel& p) { p.strings += "\xF4\x90\x80\x80"; }},
        {"stringsCutOff", Issue::meaning_text, "chunk STRS 0", [](PackModel& p) { p.strings += "\xE2\x82"; }},
        {"materialNameOutside", Issue::meaning_range, "material 0",
         [](PackModel& p) { p.materials[0].name.length = 9999; }},
        {"imageNameOverflows", Issue::meaning_range, "image 1",
         [](PackModel& p) {
             p.images[1].name = {kHuge, 0x20};
         }},
        {"skinNameOutside", Issue::meaning_range, "skin 0",
         [](PackModel& p) { p.skins[0].name.offset = 99999; }},
        {"animationNameOutside", Issue::meaning_range, "animation 1",
         [](PackModel& p) { p.animations[1].name.length = kHuge; }},
        {"nodeNameCutsCharacter", Issue::meaning_text, "node 0",
         [](PackModel& p) { --p.nodes[0].name.length; }},
        {"cameraNameOutside", Issue::meaning_range, "camera 1",
         [](PackModel& p) { p.cameras[1].name.offset = kHuge; }},
        {"lightNameOutside", Issue::meaning_range, "light 2",
         [](PackModel& p) { p.lights[2].name.length = kHuge; }},
        {"meshNameOutside", Issue::meaning_range, "mesh 1",
         [](PackModel& p) { p.meshes[1].name.length = kHuge; }},

        {"materialFlags", Issue::meaning_value, "material 0", [](PackModel& p) { p.materials[0].flags = 4; }},
        {"materialAlphaMode", Issue::meaning_value, "material 0",
         [](PackModel& p) { p.materials[0].alpha_mode = 3; }},
        {"materialNaN", Issue::meaning_value, "material 0",
         [](PackModel& p) { p.materials[0].base_color.y = kNaN; }},
        {"materialNegative", Issue::meaning_value, "material 0",
         [](PackModel& p) { p.materials[0].emissive.z = -1; }},
        {"materialRoughness", Issue::meaning_value, "material 0",
         [](PackModel& p) { p.materials[0].roughness = 1.5f; }},
        {"materialNormalScale", Issue::meaning_value, "material 0",
         [](PackModel& p) { p.materials[0].normal_scale = kInfinity; }},
        {"materialImage", Issue::meaning_reference, "material 0",
         [](PackModel& p) { p.materials[0].emissive_texture.image = 2; }},
        {"materialUvSet", Issue::meaning_value, "material 0",
         [](PackModel& p) { p.materials[0].normal_texture.uv_set = 4; }},
        {"materialWrap", Issue::meaning_value, "material 0",
         [](PackModel& p) { p.materials[0].base_color_texture.wrap_v = 3; }},
        {"materialNearest", Issue::meaning_value, "material 0",
         [](PackModel& p) { p.materials[0].base_color_texture.nearest = 2; }},
        {"materialUvTransform", Issue::meaning_value, "material 0",
         [](PackModel& p) { p.materials[0].occlusion_texture.uv_transform[5] = kNaN; }},

        {"layersMaterial", Issue::meaning_reference, "material layers 0",
         [](PackModel& p) { p.material_layers[0].material = 1; }},
        {"layersTwice", Issue::meaning_order, "material layers 1",
         [](PackModel& p) { p.material_layers.push_back(p.material_layers[0]); }},
        {"layersIor", Issue::meaning_value, "material layers 0",
         [](PackModel& p) { p.material_layers[0].ior = 0.5f; }},
        {"layersIorInfinite", Issue::meaning_value, "material layers 0",
         [](PackModel& p) { p.material_layers[0].ior = kInfinity; }},
        {"layersSpecularColor", Issue::meaning_value, "material layers 0",
         [](PackModel& p) { p.material_layers[0].specular_color.y = -1; }},
        {"layersNormalScale", Issue::meaning_value, "material layers 0",
         [](PackModel& p) { p.material_layers[0].clearcoat_normal_scale = kNaN; }},
        {"layersClearcoat", Issue::meaning_value, "material layers 0",
         [](PackModel& p) { p.material_layers[0].clearcoat = 1.5f; }},
        {"layersSheen", Issue::meaning_value, "material layers 0",
         [](PackModel& p) { p.material_layers[0].sheen_color.z = kNaN; }},
        {"layersImage", Issue::meaning_reference, "material layers 0",
         [](PackModel& p) { p.material_layers[0].sheen_texture.image = 2; }},
        {"layersUvSet", Issue::meaning_value, "material layers 0",
         [](PackModel& p) { p.material_layers[0].clearcoat_normal_texture.uv_set = 4; }},

        {"imageSizeZero", Issue::meaning_value, "image 0", [](PackModel& p) { p.images[0].width = 0; }},
        {"imageSizeHuge", Issue::meaning_value, "image 0",
         [](PackModel& p) { p.images[0].height = 1u << 31; }},
        {"imageNoMips", Issue::meaning_value, "image 0", [](PackModel& p) { p.images[0].mip_count = 0; }},
        {"imageTooManyMips", Issue::meaning_value, "image 0",
         [](PackModel& p) { p.images[0].mip_count = 4; }},
        {"imageFormat", Issue::meaning_value, "image 1", [](PackModel& p) { p.images[1].format = 9; }},
        {"imageFormatOfFiles", Issue::meaning_value, "image 1",
         [](PackModel& p) { p.images[1].format = static_cast<uint32_t>(TexelFormat::bc4_snorm); }},
        {"imageRole", Issue::meaning_value, "image 1", [](PackModel& p) { p.images[1].role = 7; }},
        {"imageSwizzle", Issue::meaning_value, "image 1", [](PackModel& p) { p.images[1].swizzle[3] = 7; }},
        {"imageError", Issue::meaning_value, "image 0", [](PackModel& p) { p.images[0].error = -1; }},
        {"imageSmoothError", Issue::meaning_value, "image 0",
         [](PackModel& p) { p.images[0].error_smooth = kInfinity; }},
        {"imageTarget", Issue::meaning_value, "image 0", [](PackModel& p) { p.images[0].target = -0.01f; }},
        {"imageTargetInfinite", Issue::meaning_value, "image 1",
         [](PackModel& p) { p.images[1].target = kInfinity; }},
        {"imageSmoothTarget", Issue::meaning_value, "image 0",
         [](PackModel& p) { p.images[0].target_smooth = kNaN; }},
        {"imageCoverage", Issue::meaning_value, "image 0",
         [](PackModel& p) { p.images[0].coverage_error = 1.5f; }},
        {"imageReserved", Issue::meaning_padding, "image 0",
         [](PackModel& p) { p.images[0].reserved_bytes[1] = 1; }},
        {"imagePiecesOutside", Issue::meaning_range, "image 1",
         [](PackModel& p) {
             p.images[1].pieces = {0, 1};
         }},
        {"imagePiecesGap", Issue::meaning_range, "image 0",
         [](PackModel& p)
         {
             p.sealImages();
             p.images[0].pieces.first = 1;
         }},
        {"imagePiecesTooFew", Issue::meaning_range, "chunk TXPG 0",
         [](PackModel& p)
         {
             p.sealImages();
             p.images[1].pieces.count = 0;
         }},
        {"imagePiecesTooMany", Issue::meaning_range, "image 1",
         [](PackModel& p)
         {
             p.sealImages();
             p.texture_pieces.push_back(p.texture_pieces.back());
             ++p.images[1].pieces.count;
         }},
        {"texturePieceGap", Issue::meaning_value, "texture piece 1",
         [](PackModel& p)
         {
             p.sealImages();
             p.texture_pieces[1].offset = 1;
         }},
        {"texturePieceSize", Issue::meaning_value, "texture piece 0",
         [](PackModel& p)
         {
             p.sealImages();
             --p.texture_pieces[0].size;
         }},
        {"texturePieceShort", Issue::chunk_size, "chunk IMGD 0",
         [](PackModel& p)
         {
             p.sealImages();
             --p.texture_pieces[0].stored_size;
         }},
        {"imageFormatOfParts", Issue::meaning_value, "image 1",
         [](PackModel& p) { p.images[1].format = static_cast<uint32_t>(TexelFormat::rgba16_srgb); }},
        {"imageFlags", Issue::meaning_value, "image 1", [](PackModel& p) { p.images[1].flags = 8; }},
        {"imageAlphaCutoff", Issue::meaning_value, "image 0",
         [](PackModel& p) { p.images[0].alpha_cutoff = -kInfinity; }},
        {"imageWithoutTexels", Issue::chunk_missing, "chunk IMGD 1",
         [](PackModel& p) { p.image_data.pop_back(); }},
        {"imageTexelsShort", Issue::chunk_size, "chunk IMGD 0",
         [](PackModel& p) { p.image_data[0].pop_back(); }},
        {"imageMipMissing", Issue::chunk_size, "chunk IMGD 0",
         [](PackModel& p) { p.images[0].mip_count = 2; }},

        {"skinRoot", Issue::meaning_reference, "skin 0", [](PackModel& p) { p.skins[0].skeleton_root = 4; }},
        {"skinJoints", Issue::meaning_range, "skin 0",
         [](PackModel& p) {
             p.skins[0].joints = {1, 2};
         }},
        {"skinReserved", Issue::meaning_padding, "skin 0", [](PackModel& p) { p.skins[0].reserved = 1; }},
        {"jointNode", Issue::meaning_reference, "joint 1",
         [](PackModel& p) { p.joints[1].node = kInvalidIndex; }},
        {"jointMatrix", Issue::meaning_value, "joint 0",
         [](PackModel& p) { p.joints[0].joint_from_bind.m[2][3] = kNaN; }},
        {"jointReserved", Issue::meaning_padding, "joint 0",
         [](PackModel& p) { p.joints[0].reserved[2] = 1; }},

        {"keyNaN", Issue::meaning_value, "chunk AKEY 0", [](PackModel& p) { p.keys.back() = kNaN; }},
        {"animationChannelsOutside", Issue::meaning_range, "animation 1",
         [](PackModel& p) { p.animations[1].channels.count = kHuge; }},
        {"animationChannelsOrder", Issue::meaning_order, "animation 1",
         [](PackModel& p) {
             p.animations[1].channels = {1, 2};
         }},
        {"animationChannelLeft", Issue::meaning_range, "channel 6",
         [](PackModel& p) { p.animations[2].light_channels.count = 1; }},
        {"animationLightChannelsOrder", Issue::meaning_order, "animation 2",
         [](PackModel& p) { p.animations[2].channels.count = 1; }},
        {"animationDuration", Issue::meaning_value, "animation 0",
         [](PackModel& p) { p.animations[0].duration = 1.5f; }},
        {"animationDurationNaN", Issue::meaning_value, "animation 0",
         [](PackModel& p) { p.animations[0].duration = kNaN; }},
        {"animationErrorNaN", Issue::meaning_value, "animation 0",
         [](PackModel& p) { p.animations[0].error = kNaN; }},
        {"animationErrorNegative", Issue::meaning_value, "animation 2",
         [](PackModel& p) { p.animations[2].error = -1; }},
        {"channelNode", Issue::meaning_reference, "channel 0",
         [](PackModel& p) { p.channels[0].target = 4; }},
        {"channelPath", Issue::meaning_value, "channel 0", [](PackModel& p) { p.channels[0].path = 9; }},
        {"channelPathOfLight", Issue::meaning_value, "channel 0",
         [](PackModel& p) { p.channels[0].path = 4; }},
        {"lightChannelPathOfNode", Issue::meaning_value, "channel 5",
         [](PackModel& p) { p.channels[5].path = 0; }},
        {"lightChannelLight", Issue::meaning_reference, "channel 5",
         [](PackModel& p) { p.channels[5].target = 3; }},
        {"lightChannelComponents", Issue::meaning_value, "channel 5",
         [](PackModel& p) { p.channels[5].components = 3; }},
        {"lightChannelPacked", Issue::meaning_value, "channel 5",
         [](PackModel& p) { p.channels[5].encoding = 1; }},
        {"lightChannelNegative", Issue::meaning_value, "channel 5",
         [](PackModel& p) { p.keys[p.channels[5].first_value + 1] = -1; }},
        {"lightChannelWide", Issue::meaning_value, "channel 6",
         [](PackModel& p) { p.keys[p.channels[6].first_value + 4] = 1.6f; }},
        {"lightChannelNoRange", Issue::meaning_value, "channel 5",
         [](PackModel& p) { p.channels[5].path = 6; }},
        {"channelInterpolation", Issue::meaning_value, "channel 1",
         [](PackModel& p) { p.channels[1].interpolation = 3; }},
        {"channelComponents", Issue::meaning_value, "channel 1",
         [](PackModel& p) { p.channels[1].components = 3; }},
        {"channelNoWeights", Issue::meaning_value, "channel 2",
         [](PackModel& p) { p.channels[2].components = 0; }},
        {"channelNoKeys", Issue::meaning_value, "channel 2",
         [](PackModel& p) { p.channels[2].key_count = 0; }},
        {"channelTimesOutside", Issue::meaning_range, "channel 0",
         [](PackModel& p) { p.channels[0].first_time = kHuge; }},
        {"channelValuesOutside", Issue::meaning_range, "channel 2",
         [](PackModel& p) { p.channels[2].first_value = static_cast<uint32_t>(p.keys.size()) - 1; }},
        {"channelCubicOutside", Issue::meaning_range, "channel 0",
         [](PackModel& p)
         {
             p.channels[0].interpolation = 2; // 27 floats
             p.channels[0].first_value = static_cast<uint32_t>(p.keys.size()) - 26;
         }},
        {"channelValuesOverflow", Issue::meaning_range, "channel 2",
         [](PackModel& p) { p.channels[2].components = 0x80000001u; }},
        {"channelTimesDecrease", Issue::meaning_order, "channel 0", [](PackModel& p) { p.keys[2] = 0.5f; }},
        {"channelTimesNegative", Issue::meaning_order, "channel 0", [](PackModel& p) { p.keys[0] = -1; }},
        {"channelWord", Issue::meaning_padding, "channel 0",
         [](PackModel& p) { p.channels[0].first_word = 1; }},
        {"channelTimeBits", Issue::meaning_padding, "channel 0",
         [](PackModel& p) { p.channels[0].time_bits = 1; }},
        {"channelValueBits", Issue::meaning_padding, "channel 1",
         [](PackModel& p) { p.channels[1].value_bits[2] = 1; }},
        {"channelEncoding", Issue::meaning_value, "channel 0",
         [](PackModel& p) { p.channels[0].encoding = 2; }},
        {"packedSpline", Issue::meaning_value, "channel 3",
         [](PackModel& p) { p.channels[3].interpolation = 2; }},
        {"packedWeights", Issue::meaning_value, "channel 3", [](PackModel& p) { p.channels[3].path = 3; }},
        {"packedValueBits", Issue::meaning_value, "channel 3",
         [](PackModel& p) { p.channels[3].value_bits[1] = 25; }},
        {"packedTimeBits", Issue::meaning_value, "channel 3",
         [](PackModel& p) { p.channels[3].time_bits = 25; }},
        {"packedStreamsOverlap", Issue::meaning_order, "channel 4",
         [](PackModel& p) { p.channels[4].first_word = 0; }},
        {"packedWordOutside", Issue::meaning_range, "channel 4",
         [](PackModel& p) { p.channels[4].first_word = kHuge; }},
        {"packedKeysOutside", Issue::meaning_range, "channel 4",
         [](PackModel& p) { p.channels[4].value_bits[0] = 24; }},
        {"packedCountOutside", Issue::meaning_range, "channel 3",
         [](PackModel& p) { p.channels[3].key_count = kHuge; }},
        {"packedBaseOutside", Issue::meaning_range, "channel 4",
         [](PackModel& p) { p.channels[4].first_value = static_cast<uint32_t>(p.keys.size()) - 3; }},
        {"packedTimesOutside", Issue::meaning_range, "channel 4",
         [](PackModel& p) { p.channels[4].first_time = static_cast<uint32_t>(p.keys.size()) - 1; }},
        {"packedTableOutside", Issue::meaning_range, "channel 3",
         [](PackModel& p) { p.channels[3].first_time = static_cast<uint32_t>(p.keys.size()) - 2; }},
        {"packedTimesDecrease", Issue::meaning_order, "channel 3",
         [](PackModel& p) { p.key_bits[0] = 2u | 1u << 6; }},
        {"packedStepNegative", Issue::meaning_value, "channel 3",
         [](PackModel& p) { p.keys[p.channels[3].first_value + 3] = -1; }},

        {"morphWeightNaN", Issue::meaning_value, "chunk MWGT 0",
         [](PackModel& p) { p.morph_weights[0] = kNaN; }},
        {"nodeParent", Issue::meaning_reference, "node 2", [](PackModel& p) { p.nodes[2].parent = 4; }},
        {"nodeMesh", Issue::meaning_reference, "node 1", [](PackModel& p) { p.nodes[1].mesh = 3; }},
        {"nodeSkin", Issue::meaning_reference, "node 3", [](PackModel& p) { p.nodes[3].skin = 1; }},
        {"nodeWeightsOutside", Issue::meaning_range, "node 3",
         [](PackModel& p) { p.nodes[3].morph_weights.first = 1; }},
        {"nodeWeightsCount", Issue::meaning_value, "node 1",
         [](PackModel& p) { p.nodes[1].morph_weights = {0, 1}; }},
        {"nodeWeightsMissing", Issue::meaning_value, "node 3",
         [](PackModel& p) { p.nodes[3].morph_weights.count = 0; }},
        {"morphTargetsWithoutEnd", Issue::meaning_value, "node 3",
         [](PackModel& p) { p.meshes[2].morph_target_count = kHuge; }},
        {"nodeTrsFlag", Issue::meaning_value, "node 0", [](PackModel& p) { p.nodes[0].has_trs = 2; }},
        {"nodeScaleNaN", Issue::meaning_value, "node 0", [](PackModel& p) { p.nodes[0].scale.y = kNaN; }},
        {"nodeMatrixInfinite", Issue::meaning_value, "node 2",
         [](PackModel& p) { p.nodes[2].parent_from_node.m[0][0] = kInfinity; }},
        {"nodeRotationNotUnit", Issue::meaning_value, "node 1",
         [](PackModel& p) { p.nodes[1].rotation.w = 0.9f; }},
        {"nodeOwnParent", Issue::meaning_tree, "node 0", [](PackModel& p) { p.nodes[0].parent = 0; }},
        {"nodeCycle", Issue::meaning_tree, "node 0", [](PackModel& p) { p.nodes[0].parent = 1; }},

        {"instanceMesh", Issue::meaning_reference, "instance 0",
         [](PackModel& p) { p.instances[0].mesh = 3; }},
        {"instanceNode", Issue::meaning_reference, "instance 1",
         [](PackModel& p) { p.instances[1].node = kInvalidIndex; }},
        {"instanceNaN", Issue::meaning_value, "instance 1",
         [](PackModel& p) { p.instances[1].world_from_object.m[1][3] = kNaN; }},
        {"instanceFlags", Issue::meaning_value, "instance 0", [](PackModel& p) { p.instances[0].flags = 2; }},
        {"instanceNotMirrored", Issue::meaning_value, "instance 1",
         [](PackModel& p) { p.instances[1].flags = 0; }},
        {"instanceScale", Issue::meaning_bounds, "instance 1",
         [](PackModel& p) { p.instances[1].scale_max = 1.99f; }},
        {"instanceScaleShear", Issue::meaning_bounds, "instance 0",
         [](PackModel& p)
         { p.instances[0].world_from_object.m[0][1] = 0.5f, p.instances[0].scale_max = 1.2f; }},

        {"cameraNode", Issue::meaning_reference, "camera 0", [](PackModel& p) { p.cameras[0].node = 4; }},
        {"cameraType", Issue::meaning_value, "camera 0", [](PackModel& p) { p.cameras[0].type = 2; }},
        {"cameraNaN", Issue::meaning_value, "camera 0", [](PackModel& p) { p.cameras[0].z_far = kNaN; }},
        {"cameraAngle", Issue::meaning_value, "camera 0",
         [](PackModel& p) { p.cameras[0].y_fov_rad = 3.2f; }},
        {"cameraFarBeforeNear", Issue::meaning_value, "camera 0",
         [](PackModel& p) { p.cameras[0].z_far = 0.05f; }},
        {"cameraFlat", Issue::meaning_value, "camera 1",
         [](PackModel& p) { p.cameras[1].x_magnification = 0; }},

        {"lightNode", Issue::meaning_reference, "light 0", [](PackModel& p) { p.lights[0].node = 4; }},
        {"lightType", Issue::meaning_value, "light 1", [](PackModel& p) { p.lights[1].type = 3; }},
        {"lightNegative", Issue::meaning_value, "light 1", [](PackModel& p) { p.lights[1].intensity = -1; }},
        {"lightInfinite", Issue::meaning_value, "light 1",
         [](PackModel& p) { p.lights[1].range = kInfinity; }},
        {"lightCone", Issue::meaning_value, "light 2",
         [](PackModel& p) { p.lights[2].inner_cone_rad = 0.6f; }},
        {"lightConeWide", Issue::meaning_value, "light 2",
         [](PackModel& p) { p.lights[2].outer_cone_rad = 1.6f; }},
        {"lightFlickerRate", Issue::meaning_value, "light 1",
         [](PackModel& p) { p.lights[1].flicker_rate = -1; }},
        {"lightFlickerRateInfinite", Issue::meaning_value, "light 1",
         [](PackModel& p) { p.lights[1].flicker_rate = kInfinity; }},
        {"lightFlickerAmplitude", Issue::meaning_value, "light 1",
         [](PackModel& p) { p.lights[1].flicker_amplitude = 1.5f; }},
        {"lightFlickerWithoutRate", Issue::meaning_value, "light 0",
         [](PackModel& p) { p.lights[0].flicker_seed = 1; }},
        {"shadowSphereNode", Issue::meaning_reference, "shadow sphere 1",
         [](PackModel& p) { p.shadow_spheres[1].node = 4; }},
        {"shadowSphereLight", Issue::meaning_reference, "shadow sphere 1",
         [](PackModel& p) { p.shadow_spheres[1].light = 3; }},
        {"shadowSphereRadius", Issue::meaning_value, "shadow sphere 0",
         [](PackModel& p) { p.shadow_spheres[0].radius = 0; }},
        {"shadowSphereCenter", Issue::meaning_value, "shadow sphere 0",
         [](PackModel& p) { p.shadow_spheres[0].center.y = kInfinity; }},
        {"shadowSphereTexels", Issue::meaning_value, "shadow sphere 1",
         [](PackModel& p) { p.shadow_spheres[1].texels = 500; }},
        {"shadowSphereReserved", Issue::meaning_padding, "shadow sphere 0",
         [](PackModel& p) { p.shadow_spheres[0].reserved = 1; }},
    };
    return cases;
}

} // namespace hearth::test
