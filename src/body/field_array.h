/// @file The array of one field of the bodies, whose block of memory others may hold too.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace cairn {

/// Like a vector, but its elements stand in a block that lives as long as somebody holds it: a view given to others
/// stays valid when the array grows into a new block or is destroyed, and shows what was there then.
template <class Element>
class FieldArray {
  public:
    using value_type = Element;

    FieldArray() = default;
    FieldArray(const FieldArray& other) { assign(other.begin(), other.end()); }
    FieldArray(FieldArray&& other) noexcept { swap(other); }
    ~FieldArray() = default;
    /// Copies into the present block where it is large enough.
    FieldArray& operator=(const FieldArray& other) {
        if (this != &other) assign(other.begin(), other.end());
        return *this;
    }
    FieldArray& operator=(FieldArray&& other) noexcept {
        swap(other);
        return *this;
    }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    Element* data() { return data_; }
    const Element* data() const { return data_; }
    Element* begin() { return data_; }
    const Element* begin() const { return data_; }
    Element* end() { return data_ + size_; }
    const Element* end() const { return data_ + size_; }
    Element& operator[](std::size_t i) { return data_[i]; }
    const Element& operator[](std::size_t i) const { return data_[i]; }

    /// New elements are default ones; a block that is too small is left to those who hold it.
    void resize(std::size_t size) {
        if (size > capacity()) grow(size + size / 8);
        // Within its capacity the vector keeps its memory, and so every view.
        if (block_) block_->resize(size);
        size_ = size;
    }
    template <class Iterator>
    void assign(Iterator first, Iterator last) {
        resize(static_cast<std::size_t>(std::distance(first, last)));
        std::copy(first, last, begin());
    }
    void assign(std::size_t size, const Element& value) {
        resize(size);
        std::fill(begin(), end(), value);
    }

    /// The elements as long as they stand in this block, which lives at least as long as what is returned.
    std::shared_ptr<const Element[]> share() const { return {block_, data_}; }

    friend bool operator==(const FieldArray& a, const FieldArray& b) { return std::ranges::equal(a, b); }

  private:
    std::size_t capacity() const { return block_ ? block_->capacity() : 0; }
    void grow(std::size_t capacity) {
        auto block = std::make_shared<std::vector<Element>>();
        block->reserve(capacity);
        if (block_.use_count() == 1) {
            block->assign(std::move_iterator(begin()), std::move_iterator(end()));
        } else {
            block->assign(begin(), end());
        }
        block_ = std::move(block);
        data_ = block_->data();
    }
    void swap(FieldArray& other) noexcept {
        std::swap(block_, other.block_);
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
    }

    std::shared_ptr<std::vector<Element>> block_;
    Element* data_ = nullptr;  ///< of the block, at hand for the loops of a step
    std::size_t size_ = 0;
};

}  // namespace cairn
