// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/astc_encoder.h"

#include "formats/base/assert.h"
#include "formats/base/half.h"

#include <astcenc.h>

#include <algorithm>
#include <list>
#include <memory>

namespace hearth::texels
{

using namespace formats;

namespace
{

struct FreeContext
{
    void operator()(astcenc_context* context) const { astcenc_context_free(context); }
};
using Context = std::unique_ptr<astcenc_context, FreeContext>;

/// Everything that a context is made of.
struct ContextKey
{
    uint32_t width;
    uint32_t height;
    astcenc_profile profile;
    uint32_t flags;
    float effort;
    float search_limit; ///< decibels of a block from which on libastcenc is content, if its own are less

    bool operator==(const ContextKey&) const = default;
};

/// Return libastcenc's effort. Normal maps take it three times as long as colours, for little.
float findEffort(Effort effort, ImageRole role)
{
    const float kEfforts[] = {ASTCENC_PRE_FASTEST, ASTCENC_PRE_FAST, ASTCENC_PRE_MEDIUM,
                              ASTCENC_PRE_THOROUGH};
    return kEfforts[static_cast<uint32_t>(effort) + (role == ImageRole::normal ? 0 : 1)];
}

/// Return libastcenc's meaning of the numbers. Light has no alpha, whose endpoints need not be floats.
astcenc_profile findProfile(TexelCoding coding)
{
    switch (coding)
    {
    case TexelCoding::srgb:
        return ASTCENC_PRF_LDR_SRGB;
    case TexelCoding::float_value:
        return ASTCENC_PRF_HDR_RGB_LDR_A;
    default:
        return ASTCENC_PRF_LDR;
    }
}

/// Return the decibels that a block of an image with smooth areas must have. libastcenc is content with fewer
/// the larger a block is, 40 dB at medium effort and 6x6, and leaves the seams that a finer format would have
/// to avoid. Draft stays quick.
float findSearchLimit(Effort effort)
{
    constexpr float kLimits[] = {0, 50, 55};
    return kLimits[static_cast<uint32_t>(effort)];
}

ContextKey makeKey(const Candidate& candidate, const StoredTexels& texels, Effort effort)
{
    ContextKey key{
        candidate.traits->block_width,         candidate.traits->block_height,
        findProfile(candidate.traits->coding), 0,
        findEffort(effort, texels.role),       candidate.has_smooth_areas ? findSearchLimit(effort) : 0.0f};
    if (texels.role == ImageRole::normal)
        key.flags |= ASTCENC_FLG_MAP_NORMAL;
    else if (candidate.has_two_parts)
        key.flags |= ASTCENC_FLG_MAP_MASK;
    if (texels.role == ImageRole::cutout)
        key.flags |= ASTCENC_FLG_USE_ALPHA_WEIGHT;
    return key;
}

Context makeContext(const ContextKey& key)
{
    astcenc_config config{};
    const astcenc_error configured =
        astcenc_config_init(key.profile, key.width, key.height, 1, key.effort, key.flags, &config);
    HEARTH_ASSERT(configured == ASTCENC_SUCCESS);
    if ((key.flags & ASTCENC_FLG_MAP_MASK) != 0)
        config.cw_g_weight = config.cw_b_weight = 0; // they repeat red
    config.tune_db_limit = std::max(config.tune_db_limit, key.search_limit);
    config.a_scale_radius = 0; // else a block would depend on its neighbours
    astcenc_context* context = nullptr;
    const astcenc_error allocated = astcenc_context_alloc(&config, 1, &context);
    HEARTH_ASSERT(allocated == ASTCENC_SUCCESS);
    return Context(context);
}

// A context takes 5 to 18 ms to make and a few MiB. A thread keeps the last ones: the search goes through a
// few footprints, image by image.
constexpr size_t kMaxContexts = 16;

/// Return the context of the calling thread.
astcenc_context* findContext(const ContextKey& key)
{
    thread_local std::list<std::pair<ContextKey, Context>> contexts; // the last used first
    const auto found = std::ranges::find(contexts, key, [](const auto& entry) { return entry.first; });
    if (found != contexts.end())
        contexts.splice(contexts.begin(), contexts, found);
    else
    {
        contexts.emplace_front(key, makeContext(key));
        if (contexts.size() > kMaxContexts)
            contexts.pop_back();
    }
    return contexts.front().second.get();
}

template <typename T, typename Convert>
std::vector<T> convertTexels(const StoredTexels& texels, const Convert& convert)
{
    std::vector<T> converted;
    converted.reserve(texels.texels.size() * 4);
    for (const DecodedTexel& texel : texels.texels)
        for (const uint16_t channel : texel)
            converted.push_back(convert(channel));
    return converted;
}

} // namespace

std::vector<std::byte> encodeAstc(const Candidate& candidate, const StoredTexels& texels, Effort effort)
{
    const bool is_light = candidate.traits->family == TexelFamily::astc_hdr;
    HEARTH_ASSERT(is_light || candidate.traits->family == TexelFamily::astc);
    std::vector<uint8_t> narrow;
    std::vector<float> wide;
    if (is_light)
        wide = convertTexels<float>(texels, [](uint16_t c) { return std::max(floatFromHalf(c), 0.0f); });
    else if (texels.is_narrow)
        narrow = convertTexels<uint8_t>(texels, [](uint16_t c) { return narrowUnorm(c); });
    else
        wide = convertTexels<float>(texels, [](uint16_t c) { return static_cast<float>(c) / 65535.0f; });
    void* slice = wide.empty() ? static_cast<void*>(narrow.data()) : wide.data();
    astcenc_image image{texels.width, texels.height, 1, wide.empty() ? ASTCENC_TYPE_U8 : ASTCENC_TYPE_F32,
                        &slice};
    std::vector<std::byte> blocks(
        static_cast<size_t>(formats::mipBytes(*candidate.traits, texels.width, texels.height)));
    constexpr astcenc_swizzle kSame{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
    astcenc_context* const context = findContext(makeKey(candidate, texels, effort));
    const astcenc_error encoded = astcenc_compress_image(
        context, &image, &kSame, reinterpret_cast<uint8_t*>(blocks.data()), blocks.size(), 0);
    HEARTH_ASSERT(encoded == ASTCENC_SUCCESS);
    const astcenc_error reset = astcenc_compress_reset(context);
    HEARTH_ASSERT(reset == ASTCENC_SUCCESS);
    return blocks;
}

} // namespace hearth::texels
