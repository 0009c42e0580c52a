// Memory that is used again and again: what a step needs for a while is taken from one block, front to back. What does
// not fit gets a block of its own, and the next time there is one block for all, so a steady step allocates nothing.
//
// Order of calls: reset -> take..., where mark -> take... -> release may come between -> reset. Spans are true until
// then.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

namespace jet::physics {

class Arena {
public:
    /// Nothing of what was taken is needed any more; `least` bytes are going to be.
    void reset(std::size_t least = 0)
    {
        most_ = std::max(most_, least);
        if (most_ > size_) {
            more_.clear();
            block_.reset();
            block_ = allocate(size_ = most_);
        }
        used_ = 0;
    }
    /// The same, and gives the memory back.
    void clear()
    {
        more_.clear();
        block_.reset();
        size_ = used_ = most_ = 0;
    }
    /// Bytes that so many values take.
    template <class T>
    static std::size_t sizeOf(std::size_t count)
    {
        return (count * sizeof(T) + kLine - 1) / kLine * kLine;
    }
    /// `count` values that are not initialized, in lines of their own.
    template <class T>
    std::span<T> take(std::size_t count)
    {
        static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= kLine);
        const std::size_t size = sizeOf<T>(count), from = used_;
        used_ += size;
        most_ = std::max(most_, used_);
        if (used_ <= size_) return {reinterpret_cast<T*>(block_.get() + from), count};
        more_.push_back(allocate(size));
        return {reinterpret_cast<T*>(more_.back().get()), count};
    }
    std::size_t mark() const { return used_; }
    /// What was taken since is not needed any more.
    void release(std::size_t mark) { used_ = mark; }
    std::size_t bytes() const { return most_; }

private:
    static constexpr std::size_t kLine = 64;
    struct Free {
        void operator()(std::byte* memory) const { operator delete(memory, std::align_val_t(kLine)); }
    };
    using Block = std::unique_ptr<std::byte, Free>;
    static Block allocate(std::size_t size)
    {
        return Block(static_cast<std::byte*>(operator new(size, std::align_val_t(kLine))));
    }

    Block block_;
    std::size_t size_ = 0, used_ = 0, most_ = 0;
    std::vector<Block> more_;
};

}  // namespace jet::physics
