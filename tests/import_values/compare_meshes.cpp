// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/compare_meshes.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

// Relative rounding of a float, and of a few operations on floats.
constexpr double kRounding = 1.2e-7;
constexpr double kUnitSlack = 5e-7;
constexpr double kWeightSlack = 1e-6;
// Flat normals come from differences of positions, whose rounding counts for slivers.
constexpr double kFlatSlack = 2e-3;
constexpr double kMinFlatArea = 1e-4;
// A vector below this length has no direction.
constexpr double kMinLength = 1e-10;

struct Vector
{
    double x = 0, y = 0, z = 0;
};

double lengthOf3(const SourceValues& values, size_t i)
{
    return std::sqrt(values.at(i, 0) * values.at(i, 0) + values.at(i, 1) * values.at(i, 1) +
                     values.at(i, 2) * values.at(i, 2));
}

Vector positionAt(const SourcePiece& piece, size_t i)
{
    return {piece.positions.at(i, 0), piece.positions.at(i, 1), piece.positions.at(i, 2)};
}

Vector subtract(Vector a, Vector b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

double length(Vector v)
{
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/// Compares the corners of one piece.
class PieceComparison
{
public:
    PieceComparison(const SourcePiece& piece, const mesh::SourceMesh& part, bool is_skinned,
                    Comparison& comparison)
        : piece_(piece), part_(part), is_skinned_(is_skinned), comparison_(comparison)
    {
    }

    /// first  index of the piece's first triangle in the part
    void compare(size_t first)
    {
        for (size_t i = 0; i < piece_.triangles.size(); ++i)
        {
            const SourceTriangle& triangle = piece_.triangles[i];
            triangle_ = first + i;
            comparison_.checkEqual(triangle.material,
                                   static_cast<int32_t>(part_.triangle_materials[triangle_]),
                                   "material of triangle", triangle_);
            for (size_t corner = 0; corner < 3; ++corner)
                compareCorner(triangle.vertices[corner], part_.indices[triangle_ * 3 + corner], triangle);
        }
    }

private:
    /// source  null: the source has 0
    void check(Value kind, const SourceValues* source, size_t vertex, size_t component, double part)
    {
        const double value = source != nullptr ? source->at(vertex, component) : 0.0;
        const double slack = source != nullptr && !source->is_exact ? kRounding * std::abs(value) : 0.0;
        comparison_.check(kind, value, part, slack, "of triangle", triangle_);
    }

    void compareCorner(size_t from, size_t to, const SourceTriangle& triangle)
    {
        const Float3 position = part_.positions[to];
        check(Value::position, &piece_.positions, from, 0, double{position.x});
        check(Value::position, &piece_.positions, from, 1, double{position.y});
        check(Value::position, &piece_.positions, from, 2, double{position.z});
        if (piece_.normals)
            compareNormal(from, to);
        else
            compareFlatNormal(to, triangle);
        compareTangent(from, to);
        for (size_t set = 0; set < kUvSets; ++set)
            compareUv(set, from, to);
        compareColor(from, to);
        if (is_skinned_)
            compareInfluences(from, to);
        else
            comparison_.exclude(Exclusion::idle_skin, piece_.joints.empty() ? 0 : 1);
        compareTargets(from, to);
    }

    void compareNormal(size_t from, size_t to)
    {
        const double norm = lengthOf3(*piece_.normals, from);
        if (!(norm > kMinLength) || !std::isfinite(norm))
            return comparison_.exclude(Exclusion::normal_without_direction);
        const Float3 normal = part_.normals.at(to);
        const double part[3] = {double{normal.x}, double{normal.y}, double{normal.z}};
        for (size_t i = 0; i < 3; ++i)
            comparison_.check(Value::normal, piece_.normals->at(from, i) / norm, part[i], kUnitSlack,
                              "of triangle", triangle_);
    }

    void compareFlatNormal(size_t to, const SourceTriangle& triangle)
    {
        const Vector a = positionAt(piece_, triangle.vertices[0]);
        const Vector u = subtract(positionAt(piece_, triangle.vertices[1]), a);
        const Vector v = subtract(positionAt(piece_, triangle.vertices[2]), a);
        const Vector n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        const double area = length(n);
        const double side = std::max({length(u), length(v), length(subtract(u, v))});
        if (!(area > kMinFlatArea * side * side))
            return comparison_.exclude(Exclusion::normal_of_flat_sliver);
        const Float3 normal = part_.normals.at(to);
        comparison_.check(Value::flat_normal, n.x / area, double{normal.x}, kFlatSlack, "x of triangle",
                          triangle_);
        comparison_.check(Value::flat_normal, n.y / area, double{normal.y}, kFlatSlack, "y of triangle",
                          triangle_);
        comparison_.check(Value::flat_normal, n.z / area, double{normal.z}, kFlatSlack, "z of triangle",
                          triangle_);
    }

    void compareTangent(size_t from, size_t to)
    {
        if (!piece_.tangents)
            return comparison_.exclude(Exclusion::tangent_generated,
                                       piece_.has_normal_texture && !part_.tangents.empty() ? 1 : 0);
        if (!piece_.has_normal_texture)
            return comparison_.exclude(Exclusion::tangent_unused);
        const double norm = lengthOf3(*piece_.tangents, from);
        if (!(norm > kMinLength) || !std::isfinite(norm))
            return comparison_.exclude(Exclusion::tangent_without_direction);
        const Float4 tangent = part_.tangents.at(to);
        const double part[4] = {double{tangent.x}, double{tangent.y}, double{tangent.z}, double{tangent.w}};
        for (size_t i = 0; i < 3; ++i)
            comparison_.check(Value::tangent, piece_.tangents->at(from, i) / norm, part[i], kUnitSlack,
                              "of triangle", triangle_);
        comparison_.check(Value::tangent, piece_.tangents->at(from, 3) < 0 ? -1 : 1, part[3], 0,
                          "w of triangle", triangle_);
    }

    void compareUv(size_t set, size_t from, size_t to)
    {
        if (part_.uvs[set].empty())
            return comparison_.checkEqual(piece_.uvs[set] ? 1 : 0, 0, "uv set of triangle", triangle_);
        const Float2 uv = part_.uvs[set][to];
        const SourceValues* values = piece_.uvs[set] ? &*piece_.uvs[set] : nullptr;
        check(Value::uv, values, from, 0, double{uv.x});
        check(Value::uv, values, from, 1, double{uv.y});
    }

    void compareColor(size_t from, size_t to)
    {
        if (part_.colors.empty())
            return comparison_.checkEqual(piece_.colors ? 1 : 0, 0, "colour of triangle", triangle_);
        const Float4 color = part_.colors[to];
        const double part[4] = {double{color.x}, double{color.y}, double{color.z}, double{color.w}};
        for (size_t i = 0; i < 4; ++i)
        {
            const bool has = piece_.colors && i < piece_.colors->components;
            const double value = has ? std::clamp(piece_.colors->at(from, i), 0.0, 1.0) : 1.0;
            comparison_.check(Value::color, value, part[i], has && !piece_.colors->is_exact ? kRounding : 0.0,
                              "of triangle", triangle_);
        }
    }

    /// Return the weights of a vertex over all sets: usable ones, scaled to the sum 1.
    std::vector<double> repairedWeights(size_t vertex) const
    {
        std::vector<double> weights;
        double sum = 0;
        for (const SourceValues& set : piece_.weights)
            for (size_t i = 0; i < 4; ++i)
            {
                const double weight = set.at(vertex, i);
                weights.push_back(weight >= 0 && std::isfinite(weight) ? weight : 0.0);
                sum += weights.back();
            }
        if (weights.empty())
            return {1};
        if (sum == 0)
            weights[0] = sum = 1;
        for (double& weight : weights)
            weight /= sum;
        return weights;
    }

    void compareInfluences(size_t from, size_t to)
    {
        const std::vector<double> weights = repairedWeights(from);
        for (size_t set = 0; set < part_.weight_sets.size(); ++set)
        {
            const Float4 in_part = part_.weight_sets[set][to];
            const double part[4] = {double{in_part.x}, double{in_part.y}, double{in_part.z},
                                    double{in_part.w}};
            for (size_t i = 0; i < 4; ++i)
            {
                const size_t influence = set * 4 + i;
                const double weight = influence < weights.size() ? weights[influence] : 0.0;
                const double joint =
                    weight > 0 && set < piece_.joints.size() ? piece_.joints[set].at(from, i) : 0.0;
                comparison_.check(Value::weight, weight, part[i], kWeightSlack, "of triangle", triangle_);
                comparison_.check(Value::joint, joint,
                                  static_cast<double>(part_.joint_sets[set][to].joint[i]), 0, "of triangle",
                                  triangle_);
            }
        }
        comparison_.checkEqual(1, piece_.weights.size() <= part_.weight_sets.size() ? 1 : 0,
                               "influence sets of triangle", triangle_);
    }

    void compareDelta(const std::optional<SourceValues>& source, const std::vector<Float3>& part, size_t from,
                      size_t to)
    {
        const Float3 delta = part.empty() ? Float3{} : part[to];
        const SourceValues* values = source ? &*source : nullptr;
        check(Value::morph_delta, values, from, 0, double{delta.x});
        check(Value::morph_delta, values, from, 1, double{delta.y});
        check(Value::morph_delta, values, from, 2, double{delta.z});
    }

    void compareTargets(size_t from, size_t to)
    {
        static const SourceTarget kNone;
        for (size_t i = 0; i < part_.morph_targets.size(); ++i)
        {
            const SourceTarget& source = i < piece_.targets.size() ? piece_.targets[i] : kNone;
            compareDelta(source.positions, part_.morph_targets[i].positions, from, to);
            compareDelta(source.normals, part_.morph_targets[i].normals, from, to);
            compareDelta(source.tangents, part_.morph_targets[i].tangents, from, to);
        }
    }

    const SourcePiece& piece_;
    const mesh::SourceMesh& part_;
    bool is_skinned_;
    Comparison& comparison_;
    size_t triangle_ = 0;
};

} // namespace

void compareMesh(const std::vector<SourcePiece>& pieces, const mesh::SourceMesh& part, bool is_skinned,
                 Comparison& comparison)
{
    size_t triangles = 0, targets = 0;
    for (const SourcePiece& piece : pieces)
    {
        triangles += piece.triangles.size();
        targets = std::max(targets, piece.targets.size());
    }
    comparison.checkEqual(static_cast<long long>(triangles), static_cast<long long>(part.triangleCount()),
                          "triangles of mesh", 0);
    comparison.checkEqual(static_cast<long long>(targets), static_cast<long long>(part.morph_targets.size()),
                          "morph targets of mesh", 0);
    if (triangles != part.triangleCount())
        return;
    size_t first = 0;
    for (const SourcePiece& piece : pieces)
    {
        PieceComparison(piece, part, is_skinned, comparison).compare(first);
        first += piece.triangles.size();
    }
}

} // namespace hearth::test
