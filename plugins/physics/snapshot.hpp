// Saving, restoring and hashing go through one list of what is dynamic: `archive(with)` of each stage calls with(x) for
// each value or array of fixed length, with.list(x, each) for lists that grow. So nothing can be saved that is not
// restored, or restored that is not hashed.
#pragma once

#include "structure.hpp"

#include <jet/result.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace jet::physics {

class SaveArchive {
public:
    /// With room for so many bytes; more is made when they do not suffice.
    explicit SaveArchive(std::size_t expected) : bytes_(expected) {}

    template <class T>
    void operator()(const T& value)
    {
        write(&value, sizeof(T));
    }
    template <class T>
    void operator()(const std::vector<T>& values)
    {
        (*this)(static_cast<std::uint64_t>(values.size()));
        write(values.data(), values.size() * sizeof(T));
    }
    template <class T, class Each>
    void list(std::vector<T>& values, Each&& each)
    {
        (*this)(static_cast<std::uint64_t>(values.size()));
        for (T& value : values) each(value);
    }
    std::vector<std::byte> take()
    {
        bytes_.resize(used_);
        return std::move(bytes_);
    }

private:
    void write(const void* from, std::size_t size)
    {
        if (bytes_.size() - used_ < size) bytes_.resize(2 * (used_ + size));
        if (size > 0) std::memcpy(bytes_.data() + used_, from, size);
        used_ += size;
    }
    std::vector<std::byte> bytes_;
    std::size_t used_ = 0;
};

class RestoreArchive {
public:
    explicit RestoreArchive(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class T>
    void operator()(T& value)
    {
        copy(&value, sizeof(T));
    }
    template <class T>
    void operator()(std::vector<T>& values)
    {
        std::uint64_t count = 0;
        (*this)(count);
        if (count != values.size()) fail();
        copy(values.data(), count * sizeof(T));
    }
    template <class T, class Each>
    void list(std::vector<T>& values, Each&& each)
    {
        std::uint64_t count = 0;
        (*this)(count);
        if (count > bytes_.size()) fail();
        values.assign(count, T());
        for (T& value : values) each(value);
    }
    bool finished() const { return bytes_.empty(); }
    [[noreturn]] static void fail()
    {
        throw Failure(Error("Physics: the saved state does not fit this world; restore it into the world that saved "
                            "it, or one built from the same scene."));
    }

private:
    void copy(void* to, std::size_t size)
    {
        if (size > bytes_.size()) fail();
        if (size > 0) std::memcpy(to, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
    }
    std::span<const std::byte> bytes_;
};

/// FNV-1a over 64-bit words of the bytes, in four lanes, as one alone would wait for itself.
inline std::uint64_t hashOf(std::span<const std::byte> bytes)
{
    std::uint64_t lanes[4] = {0xcbf29ce484222325ULL, 0x9e3779b97f4a7c15ULL, 0xbf58476d1ce4e5b9ULL, bytes.size()};
    const auto mix = [](std::uint64_t hash, std::uint64_t word) {
        hash = (hash ^ word) * 0x100000001b3ULL;
        return hash ^ hash >> 32;
    };
    const auto take = [&](std::size_t at, std::size_t size) {
        std::uint64_t words[4] = {0, 0, 0, 0};
        std::memcpy(words, bytes.data() + at, size);
        for (int i = 0; i < 4; ++i) lanes[i] = mix(lanes[i], words[i]);
    };
    std::size_t at = 0;
    for (; at + sizeof lanes <= bytes.size(); at += sizeof lanes) take(at, sizeof lanes);
    if (at < bytes.size()) take(at, bytes.size() - at);
    return mix(mix(mix(lanes[0], lanes[1]), lanes[2]), lanes[3]);
}

// A saved state: a mark, what the world is made of, what is dynamic, and the seal, a hash of that.
inline constexpr std::uint64_t kStateMark = 0x324554415453544aULL;  // "JTSSTAT2"; others at the end: other versions
inline constexpr std::size_t kStateHead = sizeof kStateMark + sizeof(Structure::Tag), kStateSeal = 8;

inline std::span<const std::byte> dynamicPart(std::span<const std::byte> state)
{
    return state.subspan(kStateHead, state.size() - kStateHead - kStateSeal);
}
/// After the dynamic part was written.
inline void seal(std::span<std::byte> state)
{
    const std::uint64_t hash = hashOf(dynamicPart(state));
    std::memcpy(state.data() + state.size() - kStateSeal, &hash, sizeof hash);
}

}  // namespace jet::physics
