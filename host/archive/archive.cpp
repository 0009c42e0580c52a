#include "archive.hpp"

#include "disk.hpp"
#include "entry_name.hpp"

#include <algorithm>
#include <archive.h>
#include <archive_entry.h>
#include <array>
#include <functional>
#include <locale.h>
#include <memory>
#include <sys/stat.h>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

struct Closer {
    void operator()(archive* a) const { archive_free(a); }  // reading or writing, it knows itself
    void operator()(archive_entry* e) const { archive_entry_free(e); }
};
using Archive = std::unique_ptr<archive, Closer>;
using Entry = std::unique_ptr<archive_entry, Closer>;

/// libarchive hands names through the thread's locale: UTF-8, whatever the user's is, while this lives.
class Utf8Locale {
public:
    Utf8Locale() : locale_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr))
    {
        if (locale_) before_ = ::uselocale(locale_);
    }
    ~Utf8Locale()
    {
        if (!locale_) return;
        ::uselocale(before_);
        ::freelocale(locale_);
    }
    Utf8Locale(const Utf8Locale&) = delete;
    Utf8Locale& operator=(const Utf8Locale&) = delete;

private:
    locale_t locale_, before_ = nullptr;
};

std::string reasonOf(archive* a)
{
    const char* text = archive_error_string(a);
    return text ? text : "unknown reason";
}

/// Walks through the entries of a package.
class ZipReader {
public:
    ZipReader(std::string_view bytes, const fs::path& package, const ArchiveLimits& limits)
        : bytes_(bytes), package_(package), limits_(limits), archive_(archive_read_new())
    {
    }

    /// Calls `visit(name)` for each file; it returns where its content goes, or null to pass over it.
    using Sink = std::function<Result<void>(std::string_view)>;
    Result<void> run(const std::function<Result<Sink>(const std::string& name, bool executable)>& visit)
    {
        // By the directory at the end, which is what other programs show; not by what else may lie in between.
        if (archive_read_support_format_zip_seekable(archive_.get()) != ARCHIVE_OK ||
            archive_read_open_memory(archive_.get(), bytes_.data(), bytes_.size()) != ARCHIVE_OK)
            return notAPackage();
        for (archive_entry* entry = nullptr;;) {
            const int status = archive_read_next_header(archive_.get(), &entry);
            if (status == ARCHIVE_EOF) return {};
            if (status != ARCHIVE_OK) return notAPackage();
            name_ = nameOf(entry);
            if (const auto fine = checkEntry(entry); !fine) return fine;
            if (archive_entry_filetype(entry) == AE_IFDIR) continue;
            const auto sink = visit(name_, (archive_entry_perm(entry) & 0100) != 0);
            if (!sink) return sink.error();
            if (const auto fine = readContent(*sink); !fine) return fine;
        }
    }

private:
    // Null where it is no UTF-8.
    static std::string nameOf(archive_entry* entry)
    {
        const char* name = archive_entry_pathname_utf8(entry);
        if (!name) name = archive_entry_pathname(entry);
        return name ? name : "";
    }

    std::string what() const { return limits_.what; }
    Error fail(const std::string& reason) const { return Error(reason, Location{package_.string(), 0, 0}); }
    Error refuse(const std::string& reason) const
    {
        return fail("this " + what() + " is refused: " + shownName(name_) + ": " + reason);
    }
    Error notAPackage() const
    {
        return fail("this is no " + what() + ", or it is damaged (" + reasonOf(archive_.get()) +
                    "); get it again, or make it with '" + limits_.maker + "'");
    }

    Result<void> checkEntry(archive_entry* entry)
    {
        if (++entries_ > limits_.files)
            return refuse("the " + what() + " has more than " + std::to_string(limits_.files) + " files");
        const bool folder = archive_entry_filetype(entry) == AE_IFDIR;
        if (archive_entry_symlink(entry)) return refuse("it is a symbolic link");
        if (archive_entry_hardlink(entry)) return refuse("it is a hard link");
        if (!folder && archive_entry_filetype(entry) != AE_IFREG) return refuse("it is neither a file nor a folder");
        if (archive_entry_is_encrypted(entry)) return refuse("it is encrypted");
        std::string_view name = name_;
        if (folder && name.ends_with('/')) name.remove_suffix(1);
        if (const auto fine = checkEntryName(name, limits_.unicodeNames); !fine) return refuse(fine.error().message);
        if (const auto fine = names_.add(name, folder); !fine) return refuse(fine.error().message);
        if (archive_entry_size_is_set(entry) &&
            archive_entry_size(entry) > static_cast<la_int64_t>(limits_.unpackedBytes))
            return refuse(tooLarge());
        return {};
    }

    std::string tooLarge() const
    {
        return "the " + what() + " unpacks to more than " + std::to_string(limits_.unpackedBytes >> 20) + " MB";
    }

    Result<void> readContent(const Sink& sink)
    {
        std::array<char, 1 << 16> buffer;
        for (;;) {
            const la_ssize_t n = archive_read_data(archive_.get(), buffer.data(), buffer.size());
            if (n == 0) return {};
            if (n < 0) return refuse("it is damaged (" + reasonOf(archive_.get()) + "); get the " + what() + " again");
            unpacked_ += static_cast<std::size_t>(n);
            if (unpacked_ > limits_.unpackedBytes) return refuse(tooLarge());
            if (unpacked_ > limits_.ratioFrom && unpacked_ / limits_.ratio > bytes_.size())
                return refuse("the " + what() + " unpacks to more than " + std::to_string(limits_.ratio) +
                              " times its size");
            if (!sink) continue;
            if (const auto fine = sink(std::string_view(buffer.data(), static_cast<std::size_t>(n))); !fine)
                return fine;
        }
    }

    Utf8Locale locale_;
    std::string_view bytes_;
    const fs::path& package_;
    const ArchiveLimits& limits_;
    Archive archive_;
    EntryNames names_;
    std::string name_;
    std::size_t entries_ = 0, unpacked_ = 0;
};

Result<void> checkSize(std::string_view bytes, const fs::path& package, const ArchiveLimits& limits)
{
    if (bytes.size() <= limits.packageBytes) return {};
    return Error("this " + std::string(limits.what) + " is larger than " + std::to_string(limits.packageBytes >> 20) +
                     " MB; it is refused",
                 Location{package.string(), 0, 0});
}

la_ssize_t append(archive*, void* target, const void* data, std::size_t size)
{
    static_cast<std::string*>(target)->append(static_cast<const char*>(data), size);
    return static_cast<la_ssize_t>(size);
}

}  // namespace

Result<std::string> writeZip(std::vector<ArchiveFile> files)
{
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    std::string bytes;
    const Utf8Locale locale;
    const Archive out(archive_write_new());
    const auto failed = [&] { return Error("the archive cannot be made: " + reasonOf(out.get())); };
    if (archive_write_set_format_zip(out.get()) != ARCHIVE_OK ||
        archive_write_set_options(out.get(), "zip:compression-level=9,zip:hdrcharset=UTF-8") != ARCHIVE_OK ||
        archive_write_set_bytes_in_last_block(out.get(), 1) != ARCHIVE_OK ||
        archive_write_open(out.get(), &bytes, nullptr, append, nullptr) != ARCHIVE_OK)
        return failed();
    for (const ArchiveFile& file : files) {
        // Also because libarchive leaks memory after a name it refuses.
        if (const auto fine = checkEntryName(file.name, true); !fine)
            return Error(shownName(file.name) + " cannot be packed: " + fine.error().message);
        const Entry entry(archive_entry_new());
        archive_entry_set_pathname_utf8(entry.get(), file.name.c_str());
        archive_entry_set_size(entry.get(), static_cast<la_int64_t>(file.content.size()));
        archive_entry_set_filetype(entry.get(), AE_IFREG);
        archive_entry_set_perm(entry.get(), file.executable ? 0755 : 0644);
        if (archive_write_header(out.get(), entry.get()) != ARCHIVE_OK) return failed();
        if (archive_write_data(out.get(), file.content.data(), file.content.size()) !=
            static_cast<la_ssize_t>(file.content.size()))
            return failed();
    }
    if (archive_write_close(out.get()) != ARCHIVE_OK) return failed();
    return bytes;
}

Result<void> unpackZip(std::string_view bytes, const fs::path& folder, const fs::path& package,
                       const ArchiveLimits& limits)
{
    if (const auto fine = checkSize(bytes, package, limits); !fine) return fine;
    std::unique_ptr<NewFile> file;
    const auto finish = [&]() -> Result<void> { return file ? file->finish() : Result<void>(); };
    const auto unpacked =
        ZipReader(bytes, package, limits).run([&](const std::string& name, bool executable) -> Result<ZipReader::Sink> {
            if (const auto done = finish(); !done) return done.error();
            auto made = NewFile::create(folder, name, executable);
            if (!made) return made.error();
            file = std::move(*made);
            return ZipReader::Sink([&](std::string_view part) { return file->write(part); });
        });
    if (!unpacked) return unpacked;
    if (const auto done = finish(); !done) return done;
    return syncFolders(folder);
}

Result<void> checkZip(std::string_view bytes, const fs::path& package, const ArchiveLimits& limits)
{
    if (const auto fine = checkSize(bytes, package, limits); !fine) return fine;
    return ZipReader(bytes, package, limits).run([](const std::string&, bool) { return ZipReader::Sink(); });
}

Result<std::string> readFromZip(std::string_view bytes, std::string_view name, const fs::path& package,
                                const ArchiveLimits& limits)
{
    if (const auto fine = checkSize(bytes, package, limits); !fine) return fine.error();
    std::string content;
    bool found = false;
    const auto read =
        ZipReader(bytes, package, limits).run([&](const std::string& entry, bool) -> Result<ZipReader::Sink> {
            if (entry != name) return ZipReader::Sink();
            found = true;
            return ZipReader::Sink([&](std::string_view part) -> Result<void> {
                content += part;
                return {};
            });
        });
    if (!read) return read.error();
    if (found) return content;
    return Error("this " + std::string(limits.what) + " has no " + std::string(name) + " at its top; make it with '" +
                     limits.maker + "'",
                 Location{package.string(), 0, 0});
}

}  // namespace jet::host
