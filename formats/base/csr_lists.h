// Lists of items in one array (compressed sparse rows).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace hearth
{

/// Lists 0, 1, 2 ... of items. At most 2^32 items in all.
template <typename Item>
class CsrLists
{
public:
    CsrLists() = default;

    /// Sort items into lists; items of a list keep their order.
    /// for_each_item  calls its argument with the number of the list and the item, for every item. It runs
    /// twice,
    ///                to count and to fill, and gives the same items in the same order.
    template <typename ForEachItem>
    CsrLists(size_t list_count, const ForEachItem& for_each_item) : offsets_(list_count + 1, 0)
    {
        for_each_item([this](size_t list, const Item&) { ++offsets_[list + 1]; });
        std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
        items_.resize(offsets_.back());
        std::vector<uint32_t> next(offsets_.begin(), offsets_.end() - 1);
        for_each_item([&](size_t list, const Item& item) { items_[next[list]++] = item; });
    }

    void reserve(size_t item_count) { items_.reserve(item_count); }
    /// Add an item to the list that endList() will end.
    void add(const Item& item) { items_.push_back(item); }
    void endList() { offsets_.push_back(static_cast<uint32_t>(items_.size())); }

    size_t size() const { return offsets_.size() - 1; }
    std::span<const Item> operator[](size_t list) const
    {
        return {items_.data() + offsets_[list], items_.data() + offsets_[list + 1]};
    }
    std::span<Item> operator[](size_t list)
    {
        return {items_.data() + offsets_[list], items_.data() + offsets_[list + 1]};
    }

    /// Return the items of all lists, one list after the other.
    const std::vector<Item>& items() const { return items_; }

private:
    std::vector<uint32_t> offsets_{0};
    std::vector<Item> items_;
};

} // namespace hearth
