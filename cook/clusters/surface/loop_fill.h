// Whether a closed way over a surface's facets can be drawn together to a point.
// See cook/clusters/README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/surface/side_twins.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Where a disc is cut along a side of a facet, so that its pieces lie in one facet each.
struct Chord
{
    uint32_t side;
    float length; ///< signed, in parts of the side
};

/// A disc's border goes along a closed way from facet to facet. Where the way comes back over a side, the disc is cut
/// between the two crossings. What is left may go around corners of facets: then these become points of the disc, and
/// it is cut from there to each of the crossings.
class LoopFill
{
public:
    /// twins  of the surface's sides
    explicit LoopFill(std::span<const uint32_t> twins) : twins_(twins), chords_(4 * kMaxCrossings) {}

    void begin()
    {
        count_ = 1;
        begun_ = chord_count_;
        overflow_ = false;
        inner_.clear();
    }

    /// The way leaves a facet at t of one of its sides, which has a twin. Whether it comes back over the side that it
    /// came over last cannot be foretold: both is prepared.
    void cross(uint32_t leaving, uint32_t entering, float t)
    {
        const Crossing& last = crossings_[count_ - 1];
        const bool back = last.entering == leaving;
        chords_[chord_count_] = {last.leaving, (1 - t) - last.t};
        chord_count_ += back ? 1 : 0;
        crossings_[count_] = {leaving, entering, t};
        count_ = back ? count_ - 1 : count_ + 1;
        if (count_ == kMaxCrossings || chord_count_ == chords_.size())
            makeRoom();
    }

    /// Forget the way and its chords.
    void drop() { chord_count_ = begun_; }

    /// The way has come back to where it began. Returns false if it cannot be filled: then there are no chords of it.
    bool close();

    /// The corners of facets around which the way went: for each a side that starts there.
    std::span<const uint32_t> inner() const { return inner_; }

    /// Of all ways that could be filled.
    std::span<const Chord> chords() const { return std::span(chords_).first(chord_count_); }

private:
    struct Crossing
    {
        uint32_t leaving = kNoSide;
        uint32_t entering = kNoSide; ///< its twin
        float t = 0;                 ///< along the one that is left
    };
    static constexpr size_t kMaxCrossings = 64;

    void makeRoom();
    void addChord(const Crossing& from, float to);
    bool turnsLeft(size_t i) const;
    uint32_t cornerAt(const Crossing& crossing, bool left) const;
    void reduce();
    bool closeRing();
    bool pushOver();
    void replaceRun(size_t run, bool left, std::span<const uint32_t> sides);

    std::span<const uint32_t> twins_;
    std::vector<Chord> chords_; ///< and room for more
    size_t chord_count_ = 0;
    size_t begun_ = 0;                              ///< chords of earlier ways
    std::array<Crossing, kMaxCrossings> crossings_; ///< what is left of the way; number 0 is none
    size_t count_ = 1;
    bool overflow_ = false;
    std::vector<uint32_t> inner_;
};

} // namespace hearth::clusters
