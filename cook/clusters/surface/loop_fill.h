// Decides if a closed traced path over a triangulated surface can be contracted to a point, and records the
// cuts.
// See cook/clusters/README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/surface/opposite_half_edges.h"
#include "formats/base/assert.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Cut of a disc along a half-edge, so that each piece of the disc lies in one triangle.
struct Chord
{
    HalfEdgeId half_edge;
    float length; ///< signed, in parts of the half-edge
};

/// Fills a closed traced path with a disc. The disc's border follows the path from triangle to triangle.
/// Where the path comes back over a half-edge, the disc is cut between the two crossings. The rest may go
/// around corners of triangles: these corners become points of the disc, and it is cut from there to each of
/// the crossings.
class LoopFiller
{
public:
    /// opposites  opposite half-edges of the surface
    explicit LoopFiller(IdSpan<HalfEdgeId, const HalfEdgeId> opposites)
        : opposites_(opposites), chords_(4 * kMaxCrossings)
    {
    }

    void begin()
    {
        count_ = 1;
        first_chord_ = chord_count_;
        overflow_ = false;
        inner_.clear();
    }

    /// Cross from a triangle to the next one at t of a half-edge with an opposite. Prepares both cases
    /// without a branch, because a return over the half-edge that was crossed last is unpredictable.
    void cross(HalfEdgeId leaving, HalfEdgeId entering, float t)
    {
        HEARTH_RUNTIME_ASSERT(opposites_[leaving] == entering);
        const Crossing& last = crossings_[count_ - 1];
        const bool back = last.entering == leaving;
        chords_[chord_count_] = {last.leaving, (1 - t) - last.t};
        chord_count_ += back ? 1 : 0;
        crossings_[count_] = {leaving, entering, t};
        count_ = back ? count_ - 1 : count_ + 1;
        if (count_ == kMaxCrossings || chord_count_ == chords_.size())
            growOrOverflow();
    }

    /// Discard the path and its chords.
    void drop() { chord_count_ = first_chord_; }

    /// Close the path. Returns false if it cannot be filled: then it has no chords.
    bool close();

    /// Return the corners of triangles that the path went around, each as a half-edge that starts there.
    std::span<const HalfEdgeId> inner() const { return inner_; }

    /// Return the chords of all paths that could be filled.
    std::span<const Chord> chords() const { return std::span(chords_).first(chord_count_); }

private:
    struct Crossing
    {
        HalfEdgeId leaving = kInvalid;
        HalfEdgeId entering = kInvalid; ///< opposite half-edge of `leaving`
        float t = 0;                    ///< along `leaving`
    };
    static constexpr size_t kMaxCrossings = 64;

    void growOrOverflow();
    void addChord(const Crossing& from, float to);
    bool turnsLeft(size_t i) const;
    HalfEdgeId cornerAt(const Crossing& crossing, bool left) const;
    void reduce();
    bool closeRing();
    bool pushOver();
    void replaceRun(size_t run, bool left, std::span<const HalfEdgeId> half_edges);

    IdSpan<HalfEdgeId, const HalfEdgeId> opposites_;
    std::vector<Chord> chords_; ///< the first chord_count_ are in use
    size_t chord_count_ = 0;
    size_t first_chord_ = 0; ///< chords of earlier paths
    /// Remaining crossings of the path; number 0 is a sentinel.
    std::array<Crossing, kMaxCrossings> crossings_;
    size_t count_ = 1;
    bool overflow_ = false;
    std::vector<HalfEdgeId> inner_;
};

} // namespace hearth::clusters
