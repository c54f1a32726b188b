// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/astc_encoder.h"

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
    float search_limit; ///< decibels of a block from which on libastcenc is content, if its own are fewer

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

/// Return the decibels that a block whose errors are seen must have. libastcenc is content with fewer the
/// larger a block is, 40 dB at medium effort and 6x6, and leaves the seams that a finer format would have to
/// avoid. Draft stays quick.
float findSeenLimit(Effort effort)
{
    constexpr float kLimits[] = {0, 50, 55};
    return kLimits[static_cast<uint32_t>(effort)];
}

ContextKey makeKey(const Candidate& candidate, ImageRole role, Effort effort, float search_limit)
{
    ContextKey key{candidate.traits->block_width,
                   candidate.traits->block_height,
                   findProfile(candidate.traits->coding),
                   ASTCENC_FLG_SELF_DECOMPRESS_ONLY, // tables of what it never encodes take long to make
                   findEffort(effort, role),
                   search_limit};
    if (role == ImageRole::normal)
        key.flags |= ASTCENC_FLG_MAP_NORMAL;
    else if (candidate.has_two_parts)
        key.flags |= ASTCENC_FLG_MAP_MASK;
    if (role == ImageRole::cutout)
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

/// Fix the error below which libastcenc stops after its first trial of a block. libastcenc 4.2 keeps the one
/// of its process's first block for all others, whatever their context (ARM-software/astc-encoder issue
/// 537). Without this, an image's bytes would depend on the images that came before it.
void fixFirstTrial()
{
    const Context context = makeContext({6, 6, ASTCENC_PRF_LDR, 0, ASTCENC_PRE_MEDIUM, 0});
    uint8_t texels[6 * 6 * 4];
    for (size_t index = 0; index < std::size(texels); ++index)
        texels[index] = static_cast<uint8_t>(index * index); // a block of one colour has no trial
    void* slice = texels;
    astcenc_image image{6, 6, 1, ASTCENC_TYPE_U8, &slice};
    constexpr astcenc_swizzle kSame{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
    uint8_t block[16];
    const astcenc_error encoded =
        astcenc_compress_image(context.get(), &image, &kSame, block, sizeof block, 0);
    HEARTH_ASSERT(encoded == ASTCENC_SUCCESS);
}

// A context takes 5 to 18 ms to make and a few MiB. A thread keeps the last ones: the search goes through a
// few footprints, image by image.
constexpr size_t kMaxContexts = 16;

/// Return the context of the calling thread.
astcenc_context* findContext(const ContextKey& key)
{
    static const bool is_fixed = (fixFirstTrial(), true);
    HEARTH_ASSERT(is_fixed);
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

/// Texels as libastcenc reads them.
class AstcImage
{
public:
    AstcImage(const StoredTexels& texels, bool is_light)
    {
        if (is_light)
            convert(texels, wide_, [](uint16_t c) { return std::max(floatFromHalf(c), 0.0f); });
        else if (texels.is_narrow)
            convert(texels, narrow_, [](uint16_t c) { return narrowUnorm(c); });
        else
            convert(texels, wide_, [](uint16_t c) { return static_cast<float>(c) / 65535.0f; });
        slice_ = wide_.empty() ? static_cast<void*>(narrow_.data()) : wide_.data();
        image_ = {texels.width, texels.height, 1, wide_.empty() ? ASTCENC_TYPE_U8 : ASTCENC_TYPE_F32,
                  &slice_};
    }
    AstcImage(const AstcImage&) = delete;
    AstcImage& operator=(const AstcImage&) = delete;

    /// blocks  of all texels: written
    void encode(const ContextKey& key, std::span<std::byte> blocks)
    {
        constexpr astcenc_swizzle kSame{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
        astcenc_context* const context = findContext(key);
        const astcenc_error encoded = astcenc_compress_image(
            context, &image_, &kSame, reinterpret_cast<uint8_t*>(blocks.data()), blocks.size(), 0);
        HEARTH_ASSERT(encoded == ASTCENC_SUCCESS);
        const astcenc_error reset = astcenc_compress_reset(context);
        HEARTH_ASSERT(reset == ASTCENC_SUCCESS);
    }

private:
    template <typename T, typename Convert>
    static void convert(const StoredTexels& texels, std::vector<T>& converted, const Convert& channel)
    {
        converted.reserve(texels.texels.size() * 4);
        for (const DecodedTexel& texel : texels.texels)
            for (const uint16_t value : texel)
                converted.push_back(channel(value));
    }

    std::vector<uint8_t> narrow_;
    std::vector<float> wide_;
    void* slice_;
    astcenc_image image_;
};

std::vector<std::byte> encodeAll(const Candidate& candidate, const StoredTexels& texels, Effort effort,
                                 float search_limit)
{
    std::vector<std::byte> blocks(
        static_cast<size_t>(formats::mipBytes(*candidate.traits, texels.width, texels.height)));
    AstcImage(texels, candidate.traits->family == TexelFamily::astc_hdr)
        .encode(makeKey(candidate, texels.role, effort, search_limit), blocks);
    return blocks;
}

/// Return blocks of an image one below the other. Texels beyond the image's edge repeat the edge, as
/// libastcenc sees them in the image.
StoredTexels stackBlocks(const StoredTexels& texels, const TexelFormatTraits& traits,
                         std::span<const size_t> blocks)
{
    StoredTexels stack{.width = traits.block_width,
                       .height = traits.block_height * static_cast<uint32_t>(blocks.size()),
                       .role = texels.role,
                       .is_narrow = texels.is_narrow};
    stack.texels.reserve(size_t{stack.width} * stack.height);
    const size_t columns = (texels.width + traits.block_width - 1) / traits.block_width;
    for (const size_t block : blocks)
        for (size_t y = block / columns * traits.block_height, rows = traits.block_height; rows > 0;
             ++y, --rows)
        {
            const auto row =
                std::span(texels.texels)
                    .subspan(std::min<size_t>(y, texels.height - 1) * texels.width, texels.width);
            const size_t left = block % columns * traits.block_width;
            const std::span<const DecodedTexel> part =
                row.subspan(left, std::min<size_t>(traits.block_width, texels.width - left));
            stack.texels.insert(stack.texels.end(), part.begin(), part.end());
            stack.texels.insert(stack.texels.end(), traits.block_width - part.size(), row.back());
        }
    return stack;
}

} // namespace

std::vector<std::byte> encodeAstc(const Candidate& candidate, const StoredTexels& texels, Effort effort)
{
    const TexelFormatTraits& traits = *candidate.traits;
    HEARTH_ASSERT(traits.family == TexelFamily::astc || traits.family == TexelFamily::astc_hdr);
    const float seen_limit = findSeenLimit(effort);
    const std::vector<BlockSearch>& search = texels.search;
    std::vector<size_t> seen, hidden;
    for (size_t block = 0; block < search.size(); ++block)
        if (search[block] != BlockSearch::none)
            (search[block] == BlockSearch::longer && seen_limit > 0 ? seen : hidden).push_back(block);
    if (hidden.size() == search.size())
        return encodeAll(candidate, texels, effort, 0);
    if (seen.size() == search.size())
        return encodeAll(candidate, texels, effort, seen_limit);
    std::vector<std::byte> blocks(search.size() * traits.block_bytes);
    const auto encodeSome = [&](std::span<const size_t> some, float search_limit)
    {
        if (some.empty())
            return;
        const std::vector<std::byte> encoded =
            encodeAll(candidate, stackBlocks(texels, traits, some), effort, search_limit);
        for (size_t i = 0; i < some.size(); ++i)
            std::ranges::copy(std::span(encoded).subspan(i * traits.block_bytes, traits.block_bytes),
                              blocks.begin() + static_cast<ptrdiff_t>(some[i] * traits.block_bytes));
    };
    encodeSome(seen, seen_limit);
    encodeSome(hidden, 0);
    return blocks;
}

} // namespace hearth::texels
