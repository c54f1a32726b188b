// Index types of the cluster builder, and arrays that take only their own kind of index: a wedge where a
// position id is wanted does not compile.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/assert.h"
#include "formats/base/index.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace hearth::clusters
{

/// Vertex of a prepared mesh.
enum class VertexId : uint32_t
{
};

/// Position of a prepared mesh: stands for all of its vertices at the same place.
enum class MeshPositionId : uint32_t
{
};

/// Cluster of a ClusterStore.
enum class ClusterId : uint32_t
{
};

/// Group of the hierarchy under construction: counted over all levels, finest level first.
enum class GroupId : uint32_t
{
};

/// Position of a group.
enum class PositionId : uint32_t
{
};

/// Wedge of a group: a vertex together with a material.
enum class WedgeId : uint32_t
{
};

/// Triangle of a mesh, of a group, or of its simplification.
enum class TriangleId : uint32_t
{
};

/// Corner of a triangle: corner k of triangle t is 3 t + k.
enum class CornerId : uint32_t
{
};

/// Half-edge of a triangle. It has the number of the corner where it starts, and runs to the next one.
using HalfEdgeId = CornerId;

template <typename T>
concept IndexType = std::is_enum_v<T> && std::same_as<std::underlying_type_t<T>, uint32_t>;

/// Stands for "none" where an index of any type stands, like kInvalidIndex.
struct InvalidIndex
{
    template <IndexType Id>
    constexpr operator Id() const
    {
        return Id{kInvalidIndex};
    }
};
inline constexpr InvalidIndex kInvalid;

template <IndexType Id>
constexpr bool operator==(Id id, InvalidIndex)
{
    return id == Id{kInvalidIndex};
}

/// Return the number of an index, for arrays of other libraries and for arithmetic.
template <IndexType Id>
constexpr uint32_t toIndex(Id id)
{
    return static_cast<uint32_t>(id);
}

/// Return the index with a number.
template <IndexType Id>
constexpr Id toId(size_t number)
{
    return static_cast<Id>(static_cast<uint32_t>(number));
}

/// Return the numbers of another array, or its indices of another type, as indices.
template <IndexType Id, typename Numbers>
std::vector<Id> convertIds(const Numbers& numbers)
{
    std::vector<Id> ids(numbers.size());
    std::transform(numbers.begin(), numbers.end(), ids.begin(),
                   [](auto number) { return static_cast<Id>(number); });
    return ids;
}

/// True if all indices are below `limit`. A pass over the corners of a group costs a thousandth of building
/// it: for debug builds, except where the indices come from afar.
template <typename Ids>
constexpr bool allBelow(const Ids& ids, size_t limit)
{
    uint32_t largest = 0;
    for (const auto id : ids)
        largest = std::max(largest, toIndex(id));
    return ids.empty() || largest < limit;
}

/// Consecutive indices.
template <IndexType Id>
class IdRange
{
public:
    class Iterator
    {
    public:
        using value_type = Id;
        using difference_type = std::ptrdiff_t;
        using pointer = const Id*;
        using reference = Id;
        using iterator_category = std::input_iterator_tag;

        constexpr Iterator() = default;
        explicit constexpr Iterator(uint32_t number) : number_(number) {}
        constexpr Id operator*() const { return Id{number_}; }
        constexpr Iterator& operator++()
        {
            ++number_;
            return *this;
        }
        constexpr Iterator operator++(int) { return Iterator(number_++); }
        constexpr bool operator==(const Iterator& other) const = default;

    private:
        uint32_t number_ = 0;
    };

    constexpr IdRange(uint32_t first, uint32_t last) : first_(first), last_(last) {}
    constexpr Iterator begin() const { return Iterator(first_); }
    constexpr Iterator end() const { return Iterator(last_); }

private:
    uint32_t first_;
    uint32_t last_;
};

/// Return the indices 0 .. count - 1.
template <IndexType Id>
constexpr IdRange<Id> makeIds(size_t count)
{
    return {0, static_cast<uint32_t>(count)};
}

/// Return corner `k` of a triangle.
constexpr CornerId makeCorner(TriangleId triangle, uint32_t k)
{
    return CornerId{toIndex(triangle) * 3 + k};
}

/// Return the three corners of a triangle, or its half-edges.
constexpr IdRange<CornerId> makeCorners(TriangleId triangle)
{
    return {toIndex(triangle) * 3, toIndex(triangle) * 3 + 3};
}

/// Return the triangle of a corner or half-edge.
constexpr TriangleId cornerTriangle(CornerId corner)
{
    return TriangleId{toIndex(corner) / 3};
}

/// Return the number of a corner in its triangle: 0, 1 or 2.
constexpr uint32_t cornerNumber(CornerId corner)
{
    return toIndex(corner) % 3;
}

/// Return the half-edge that starts where the given one ends.
constexpr HalfEdgeId nextHalfEdge(HalfEdgeId half_edge)
{
    const uint32_t number = toIndex(half_edge);
    return HalfEdgeId{number % 3 == 2 ? number - 2 : number + 1};
}

/// Return the half-edge that ends where the given one starts.
constexpr HalfEdgeId previousHalfEdge(HalfEdgeId half_edge)
{
    const uint32_t number = toIndex(half_edge);
    return HalfEdgeId{number % 3 == 0 ? number + 2 : number - 1};
}

/// Access to an array by index, for IdSpan and IdVector. Debug builds check each index.
template <IndexType Id, typename T, typename Values>
class IdAccess : protected Values
{
public:
    using typename Values::value_type;
    using Values::back;
    using Values::begin;
    using Values::data;
    using Values::empty;
    using Values::end;
    using Values::front;
    using Values::size;

    constexpr bool contains(Id id) const { return toIndex(id) < size(); }

    /// Return all indices, in order.
    constexpr IdRange<Id> ids() const { return makeIds<Id>(size()); }

    /// Return the number of triangles whose corners these are.
    constexpr size_t triangleCount() const
        requires std::same_as<Id, CornerId>
    {
        return size() / 3;
    }
    constexpr IdRange<TriangleId> triangles() const
        requires std::same_as<Id, CornerId>
    {
        return makeIds<TriangleId>(triangleCount());
    }

    /// Return the values of a triangle's corners.
    constexpr std::array<std::remove_const_t<T>, 3> triangle(TriangleId triangle) const
        requires std::same_as<Id, CornerId>
    {
        HEARTH_RUNTIME_ASSERT(toIndex(triangle) < triangleCount());
        const auto* const first = data() + size_t{toIndex(triangle)} * 3;
        return {first[0], first[1], first[2]};
    }

protected:
    using Values::Values;
    constexpr IdAccess() = default;
    explicit constexpr IdAccess(Values values) : Values(std::move(values)) {}

    constexpr size_t checkedIndex(Id id) const
    {
        HEARTH_RUNTIME_ASSERT(contains(id));
        return toIndex(id);
    }
};

/// Array with one value for each index.
template <IndexType Id, typename T>
class IdVector : public IdAccess<Id, T, std::vector<T>>
{
    using Values = std::vector<T>;
    using Access = IdAccess<Id, T, Values>;

public:
    using Access::Access;
    using Values::assign;
    using Values::clear;
    using Values::emplace_back;
    using Values::insert;
    using Values::pop_back;
    using Values::push_back;
    using Values::reserve;
    using Values::resize;

    IdVector() = default;
    explicit IdVector(Values values) : Access(std::move(values)) {}

    T& operator[](Id id) { return Values::operator[](this->checkedIndex(id)); }
    const T& operator[](Id id) const { return Values::operator[](this->checkedIndex(id)); }

    /// Return the index of the next value that is appended.
    Id nextId() const { return toId<Id>(this->size()); }

    /// Return the values as a plain array.
    Values& values() { return *this; }
    const Values& values() const { return *this; }
};

/// View of an array with one value for each index.
template <IndexType Id, typename T>
class IdSpan : public IdAccess<Id, T, std::span<T>>
{
    using Values = std::span<T>;
    using Access = IdAccess<Id, T, Values>;

public:
    constexpr IdSpan() = default;
    explicit constexpr IdSpan(Values values) : Access(values) {}
    constexpr IdSpan(IdVector<Id, std::remove_const_t<T>>& vector) : Access(Values(vector.values())) {}
    constexpr IdSpan(const IdVector<Id, std::remove_const_t<T>>& vector)
        requires std::is_const_v<T>
        : Access(Values(vector.values()))
    {
    }
    template <typename Other>
        requires std::same_as<const Other, T>
    constexpr IdSpan(IdSpan<Id, Other> other) : Access(Values(other.data(), other.size()))
    {
    }

    constexpr T& operator[](Id id) const { return Values::operator[](this->checkedIndex(id)); }
};

/// Values of the corners of triangles, three for each triangle.
template <typename T>
using CornerVector = IdVector<CornerId, T>;
template <typename T>
using CornerSpan = IdSpan<CornerId, T>;

} // namespace hearth::clusters
