// Tally of a comparison between the values of a source and those of its import part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace hearth::test
{

/// Kinds of values, each with tallies of its own.
enum class Value : uint8_t
{
    structure, ///< counts, references, materials of triangles, flags
    position,
    normal,
    flat_normal, ///< of a primitive without normals
    tangent,
    uv,
    color,
    joint,
    weight,
    morph_delta,
    key_time,
    key_value,
    node,     ///< TRS, matrices, rest weights
    instance, ///< world transforms
    inverse_bind,
    factor, ///< of materials
    texture_transform,
    count,
};
const char* valueName(Value value);

/// Reasons why a value of a source has no equal in the part. The table kExclusions explains each.
enum class Exclusion : uint8_t
{
    normal_without_direction,
    normal_of_flat_sliver,
    tangent_unused,
    tangent_generated,
    tangent_without_direction,
    idle_skin,
    generated_level,
    converted_material,
    skinned_instance,
    count,
};

struct ExclusionReason
{
    const char* name;
    const char* reason;
};

inline constexpr std::array<ExclusionReason, static_cast<size_t>(Exclusion::count)> kExclusions{{
    {"normal without a direction", "is replaced by the direction of its triangles (W1402)"},
    {"flat normal of a sliver", "rounding of positions turns it; the area is below 1e-4 of its longest side"},
    {"tangent unused", "no normal texture of the primitives with these attributes uses it (W1400)"},
    {"tangent generated", "the source has none, and a normal texture needs it"},
    {"tangent without a direction", "is replaced by +x (W1402)"},
    {"joints of an idle skin", "no node draws the mesh by a skin that moves it (W1401)"},
    {"level of detail", "is transformed into the space of the finest mesh"},
    {"specular-glossiness", "is converted to metallic-roughness (W1401)"},
    {"instance of a skinned mesh", "its joints place it, so that the node's transform does not count"},
}};

class Comparison
{
public:
    explicit Comparison(std::string file) : file_(std::move(file)) {}

    /// Compare a value of the part with the source's. slack 0: equal after rounding to float
    void check(Value kind, double source, double part, double slack, const char* what, size_t where);
    /// Compare two whole numbers or references.
    void checkEqual(long long source, long long part, const char* what, size_t where);
    void exclude(Exclusion reason, size_t count = 1);
    void fail(const std::string& what);

    size_t compared(Value kind) const { return compared_[static_cast<size_t>(kind)]; }
    size_t excluded(Exclusion reason) const { return excluded_[static_cast<size_t>(reason)]; }
    size_t differences() const { return differences_; }
    /// The first differences, a line each.
    const std::string& report() const { return report_; }

    /// Add the tallies of another file.
    void add(const Comparison& other);
    /// Return the numbers compared and excluded, a line each.
    std::string table() const;

private:
    void addDifference(const std::string& line);

    std::string file_;
    std::array<size_t, static_cast<size_t>(Value::count)> compared_{};
    std::array<size_t, static_cast<size_t>(Exclusion::count)> excluded_{};
    size_t differences_ = 0;
    std::string report_;
};

} // namespace hearth::test
