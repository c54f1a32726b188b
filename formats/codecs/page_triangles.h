// Decodes the triangles of a geometry page's clusters (formats/codecs/page_codec.h), two clusters at a time.
// Each triangle depends on the one before, so the processor works on the other cluster while it waits.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/page_streams.h"

#include <algorithm>
#include <cstring>

// Safe without a check at every byte: streams have room for a whole cluster after their end, and counts are
// checked after each cluster.

namespace hearth::formats::page
{

/// Pack three vertices of a cluster into the lowest bytes of a word.
constexpr uint32_t packThreeBytes(uint32_t a, uint32_t b, uint32_t c)
{
    return a | b << 8 | c << 16;
}

/// Size of the edge stack: invalid codes pop more edges than were pushed.
inline constexpr size_t kEdgeStackSize = kMaxClusterTriangles + 1;

/// Corners of the triangles of a cluster, and the sources of its vertices.
struct Connectivity
{
    std::array<uint8_t, kClusterCorners + 1> indices; ///< with room for a word at the last triangle
    /// For each new vertex, an edge's two vertices and the third corner of the triangle next to it, in the
    /// lowest bytes.
    std::array<uint32_t, kClusterCorners + 1> edges;
    std::array<uint8_t, kClusterCorners + 1> new_vertices;
    std::array<uint8_t, kClusterCorners + 1> references; ///< vertices equal to one of an earlier cluster
    uint32_t vertex_count = 0;
    uint32_t new_count = 0;
    std::array<uint32_t, 2 * kEdgeStackSize + 1> kept{}; ///< stack of edges while the cluster is decoded

    uint32_t referenceCount() const { return vertex_count - new_count; }
};

/// Effect of a code, as numbers for branch-free arithmetic: the next code is unpredictable, and a
/// mispredicted branch costs more than a triangle.
struct CodeEffect
{
    int64_t from;        ///< edge it starts from: -1 top of the stack, 0 the left one, 1 the right one
    int64_t kept;        ///< number of edges pushed, or popped if negative
    uint64_t is_reused;  ///< 1: its corner is an earlier vertex of the cluster
    uint32_t is_new;     ///< 1: its corner is a new vertex
    uint32_t reuse_mask; ///< all bits if `is_reused`, else none
};

inline constexpr std::array<CodeEffect, 16> kCodeEffects = []
{
    constexpr std::array<int64_t, 6> kFrom{1, 1, 0, -1, 0, 0};
    constexpr std::array<int64_t, 6> kPushed{0, 1, 0, -1, 0, 0};
    std::array<CodeEffect, 16> effects{};
    for (uint32_t code = 0; code < effects.size(); ++code)
    {
        const uint32_t start = code / 3;
        const uint32_t corner = code % 3;
        effects[code] = {kFrom[start], kPushed[start], corner == kCornerReuse ? 1u : 0u,
                         corner == kCornerNew ? 1u : 0u, corner == kCornerReuse ? ~0u : 0u};
    }
    return effects;
}();

class TriangleDecoder
{
public:
    /// Decode two clusters, and advance the streams. False if a corner names a vertex that does not exist
    /// yet, an edge is popped from an empty stack, or a stream ends too soon.
    ///
    /// triangle_counts  counts of a cluster at an even index of the page and of the next one; 0 if there is
    ///                  none
    static bool decode(Streams& streams, std::array<uint32_t, 2> triangle_counts,
                       std::array<Connectivity, 2>& out)
    {
        State first(streams, 0, triangle_counts[0], out[0]);
        State second(streams, 1, triangle_counts[1], out[1]);
        const std::array<uint32_t, 2> codes{codeCount(triangle_counts[0]), codeCount(triangle_counts[1])};
        const uint32_t both = std::min(codes[0], codes[1]) / 2;
        for (uint32_t pair = 0; pair < both; ++pair)
        {
            first.decodePair(pair);
            second.decodePair(pair);
        }
        first.decodeRest(both, codes[0]);
        second.decodeRest(both, codes[1]);
        const bool good_first = first.finish(streams, 0);
        return second.finish(streams, 1) && good_first;
    }

private:
    class State
    {
    public:
        State(Streams& streams, size_t place, uint32_t triangle_count, Connectivity& out)
            : codes_(streams.codes.at),
              restarts_(streams.restarts[place].at),
              reuses_(streams.reuses[place].at),
              out_(&out)
        {
            streams.codes.at += codeBytes(triangle_count);
            if (triangle_count > 0)
            {
                restart();
                writeTriangle(0);
            }
        }

        [[gnu::always_inline]] void decodePair(uint32_t pair)
        {
            const uint32_t codes = codes_[pair];
            decodeTriangle(2 * pair + 1, codes & 15u);
            decodeTriangle(2 * pair + 2, codes >> 4);
        }

        [[gnu::always_inline]] void decodeRest(uint32_t pair, uint32_t code_count)
        {
            for (; pair < code_count / 2; ++pair)
                decodePair(pair);
            if (code_count % 2 != 0)
                decodeTriangle(2 * pair + 1, codes_[pair] & 15u);
        }

        bool finish(Streams& streams, size_t place) const
        {
            out_->vertex_count = newest_ + 1;
            out_->new_count = new_count_;
            streams.restarts[place].at = restarts_;
            streams.reuses[place].at = reuses_;
            return error_bits_ >= 0 && !streams.restarts[place].isOverrun() &&
                   !streams.reuses[place].isOverrun();
        }

    private:
        [[gnu::always_inline]] void decodeTriangle(uint32_t triangle, uint32_t code)
        {
            if (code == kCodeRestart) [[unlikely]]
                restart();
            else
            {
                const CodeEffect& effect = kCodeEffects[code];
                uint32_t* const kept = out_->kept.data() + kEdgeStackSize + stack_size_;
                // the left edge and the corner opposite to it; the right ones are one byte above
                const uint32_t left = __builtin_bswap32(triangle_);
                kept[0] = left;
                kept[1] = left >> 8;
                const uint32_t from = kept[effect.from];
                stack_size_ += effect.kept;
                error_bits_ |= static_cast<int32_t>(stack_size_);
                triangle_ = (from & 0xFFFFu) | corner(effect, from) << 16 | from << 24;
            }
            writeTriangle(triangle);
        }

        [[gnu::always_inline]] void writeTriangle(uint32_t triangle)
        {
            std::memcpy(out_->indices.data() + size_t{triangle} * 3, &triangle_, sizeof(triangle_));
        }

        [[gnu::always_inline]] uint32_t corner(const CodeEffect& effect, uint32_t from)
        {
            const uint32_t is_reused = ((from >> 8) - *reuses_) & 255u;
            const uint32_t added = newest_ + 1;
            out_->edges[new_count_] = from;
            out_->new_vertices[new_count_] = static_cast<uint8_t>(added);
            out_->references[added - new_count_] = static_cast<uint8_t>(added);
            newest_ = added + effect.reuse_mask;
            new_count_ += effect.is_new;
            reuses_ += effect.is_reused;
            const uint32_t vertex = newest_ ^ ((newest_ ^ is_reused) & effect.reuse_mask);
            error_bits_ |= static_cast<int32_t>(newest_ - vertex);
            return vertex;
        }

        [[gnu::always_inline]] void restart()
        {
            // on a copy: a variable whose address is taken would not stay in a register
            State copy = *this;
            restart(copy);
            *this = copy;
        }

        [[gnu::noinline]] static void restart(State& s)
        {
            const uint32_t kinds = *s.restarts_++;
            if ((kinds & kinds >> 1 & 0x15u) != 0 || kinds > 63)
                s.error_bits_ = -1;
            // before the first vertex of the cluster, its slot holds the last vertex of the previous cluster
            const uint32_t before = s.newest_ == ~0u ? 0 : s.newest_ & 255u;
            const uint32_t a =
                s.corner(kCodeEffects[(kinds & 3u) % 3], packThreeBytes(before, before, before));
            const uint32_t b = s.corner(kCodeEffects[(kinds >> 2 & 3u) % 3], packThreeBytes(a, a, a));
            const uint32_t c = s.corner(kCodeEffects[(kinds >> 4 & 3u) % 3], packThreeBytes(b, b, b));
            s.triangle_ = packThreeBytes(a, b, c) | a << 24;
        }

        const uint8_t* codes_;
        const uint8_t* restarts_;
        const uint8_t* reuses_;
        Connectivity* out_;
        uint32_t triangle_ = 0; ///< its corners a, b, c in the lowest bytes, and a in the highest
        uint32_t newest_ = ~0u; ///< newest vertex
        uint32_t new_count_ = 0;
        int32_t error_bits_ = 0; ///< negative once an input was invalid
        int64_t stack_size_ = 0; ///< edges on the stack; negative once a code was invalid
    };
};

} // namespace hearth::formats::page
