// Saving, restoring and hashing go through one list of what is dynamic: `archive(with)` of each stage calls with(x) for
// each value or array of fixed length, with.list(x, each) for lists that grow. So nothing can be saved that is not
// restored, or restored that is not hashed.
#pragma once

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
    template <class T>
    void operator()(const T& value)
    {
        const auto* bytes = reinterpret_cast<const std::byte*>(&value);
        bytes_.insert(bytes_.end(), bytes, bytes + sizeof(T));
    }
    template <class T>
    void operator()(const std::vector<T>& values)
    {
        (*this)(static_cast<std::uint64_t>(values.size()));
        const auto* bytes = reinterpret_cast<const std::byte*>(values.data());
        bytes_.insert(bytes_.end(), bytes, bytes + values.size() * sizeof(T));
    }
    template <class T, class Each>
    void list(std::vector<T>& values, Each&& each)
    {
        (*this)(static_cast<std::uint64_t>(values.size()));
        for (T& value : values) each(value);
    }
    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
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
        throw Failure(
            Error("The saved physics state does not fit this world; it can only be restored into the world that "
                  "saved it, or one built from the same scene."));
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

/// FNV-1a over 64-bit words of the bytes.
inline std::uint64_t hashOf(std::span<const std::byte> bytes)
{
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (std::size_t at = 0; at < bytes.size(); at += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
        hash = (hash ^ word) * 0x100000001b3ULL;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace jet::physics
