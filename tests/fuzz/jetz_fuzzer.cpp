// A zip, in two ways: the input is the file; and the input lists the entries of a file whose checksums are right, which
// the fuzzer could not find by itself.
#include "fuzz/fuzzing.hpp"
#include "fuzz/temporary_folder.hpp"
#include "host/archive/archive.hpp"

namespace {

using namespace jet;
namespace fs = std::filesystem;

std::uint32_t crcOf(std::string_view bytes)
{
    std::uint32_t crc = ~0U;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
    }
    return ~crc;
}

void add(std::string& out, std::uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
}

/// Writes zips as a villain would: any name, any kind of entry. Content is stored as it is.
class Villain {
public:
    void entry(std::string_view name, std::string_view content, unsigned mode)
    {
        std::string common;
        add(common, 0x0800, 2), add(common, 0, 2), add(common, 0, 2), add(common, 0x21, 2);  // UTF-8, stored, 1980
        add(common, crcOf(content), 4), add(common, content.size(), 4), add(common, content.size(), 4);
        add(common, name.size(), 2), add(common, 0, 2);
        directory_ += "PK\1\2";
        add(directory_, 0x0314, 2), add(directory_, 20, 2);  // made on Unix
        directory_ += common;
        add(directory_, 0, 2), add(directory_, 0, 2), add(directory_, 0, 2);
        add(directory_, static_cast<std::uint64_t>(mode) << 16, 4), add(directory_, zip_.size(), 4);
        directory_ += name;
        zip_ += "PK\3\4";
        add(zip_, 20, 2);
        (((zip_ += common) += name) += content);
        ++count_;
    }

    std::string zip() const
    {
        std::string all = zip_ + directory_ + "PK\5\6";
        add(all, 0, 4), add(all, count_, 2), add(all, count_, 2);
        add(all, directory_.size(), 4), add(all, zip_.size(), 4), add(all, 0, 2);
        return all;
    }

private:
    std::string zip_, directory_;
    std::size_t count_ = 0;
};

// Entries as "kind name \0 content \0 kind name \0 content".
std::string zipOf(std::string_view text)
{
    static constexpr unsigned kModes[] = {0100644, 0100755, 0040755, 0120777, 0020666, 0};
    Villain villain;
    const auto word = [&] {
        const std::string_view one = text.substr(0, text.find('\0'));
        text.remove_prefix(std::min(one.size() + 1, text.size()));
        return one.substr(0, 60'000);
    };
    for (int i = 0; i < 20 && !text.empty(); ++i) {
        const unsigned mode = kModes[static_cast<unsigned char>(text.front()) % std::size(kModes)];
        text.remove_prefix(1);
        const std::string_view name = word();
        villain.entry(name, word(), mode);
    }
    return villain.zip();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::string zip = data[0] % 2 == 0 ? std::string(bytes) : zipOf(bytes);
    const fs::path target = fuzz::temporaryFolder() / "around" / "target";
    fs::create_directories(target);
    host::ArchiveLimits limits;
    limits.unpackedBytes = 4U << 20, limits.files = 100, limits.unicodeNames = true;
    const auto unpacked = host::unpackZip(zip, target, "fuzz.jetz", limits);
    std::uintmax_t total = 0;
    for (const auto& entry : fs::recursive_directory_iterator(target)) {
        fuzz::require(!entry.is_symlink(), "no links come out of a zip");
        if (entry.is_regular_file()) total += entry.file_size();
    }
    fuzz::require(total <= limits.unpackedBytes + (1U << 16), "no more comes out than is allowed");
    for (const auto& entry : fs::directory_iterator(target.parent_path()))
        fuzz::require(entry.path() == target, "nothing is written beside the folder");
    if (unpacked) {
        EventsCenter events;
        (void)Project::load(target, events, fuzz::catalog());
    } else {
        fuzz::require(!unpacked.error().message.empty(), "an error says what is wrong");
    }
    fs::remove_all(target.parent_path());
    return 0;
}
