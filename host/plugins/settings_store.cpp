#include "settings_store.hpp"

#include <jet/format.hpp>

#include <nlohmann/json.hpp>

#include <mutex>
#include <optional>

namespace jet::host {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// The file's content; an empty object where there is none. The error says that it is not JSON.
Result<Json> readStored(const fs::path& file)
{
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return Json::object();
    const auto text = readFile(file);
    if (!text) return text.error();
    Json json = Json::parse(*text, nullptr, false, true);
    if (json.is_object()) return json;
    return Error("these settings are not a JSON object; mend or delete the file", Location{file.string(), 1, 1});
}

class StoredSettings final : public Settings {
public:
    StoredSettings(SettingsStore& store, fs::path file, std::string page, const PropertyTable& table)
        : store_(store), file_(std::move(file)), page_(std::move(page)), table_(table)
    {
        const auto stored = readStored(file_);
        if (!stored || !stored->contains(page_) || !(*stored)[page_].is_object()) return;
        for (const auto& [id, text] : (*stored)[page_].items()) {
            const PropertySpec* spec = table_.find(id);
            if (!spec || !text.is_string()) continue;
            const auto value = Value::parse(spec->kind, text.get_ref<const std::string&>());
            if (value && spec->check(*value)) values_.set(id, *value);
        }
    }

    const PropertyTable& table() const override { return table_; }

    Value value(std::string_view id) const override
    {
        const std::lock_guard lock(mutex_);
        return values_.get(id, table_);
    }

    Result<void> set(std::string_view id, Value value) override
    {
        const PropertySpec* spec = table_.find(id);
        if (!spec) return unknown(id);
        if (const auto fine = spec->check(value); !fine) return fine;
        if (const auto written = write(id, value.text()); !written) return written;
        {
            const std::lock_guard lock(mutex_);
            values_.set(id, std::move(value));
        }
        tell(id);
        return {};
    }

    Result<void> reset(std::string_view id) override
    {
        if (!table_.find(id)) return unknown(id);
        if (const auto written = write(id, std::nullopt); !written) return written;
        {
            const std::lock_guard lock(mutex_);
            values_.erase(id);
        }
        tell(id);
        return {};
    }

private:
    Error unknown(std::string_view id) const
    {
        return Error("The settings page \"" + page_ + "\" has no property \"" + std::string(id) + "\".");
    }

    // Read again before writing: another running editor may have stored other values meanwhile.
    Result<void> write(std::string_view id, const std::optional<std::string>& text) const
    {
        if (file_.empty()) return {};
        auto stored = readStored(file_);
        if (!stored) return stored.error();
        Json& page = (*stored)[page_];
        if (!page.is_object()) page = Json::object();
        if (text) {
            page[std::string(id)] = *text;
        } else {
            page.erase(std::string(id));
        }
        std::error_code ignored;
        fs::create_directories(file_.parent_path(), ignored);
        return writeFileAtomically(file_, stored->dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    }

    void tell(std::string_view id) const
    {
        if (store_.onChanged) store_.onChanged({page_, std::string(id)});
    }

    SettingsStore& store_;
    fs::path file_;
    std::string page_;
    PropertyTable table_;
    mutable std::mutex mutex_;  // guards the values: plugins read them on any thread
    Properties values_;
};

}  // namespace

std::shared_ptr<Settings> SettingsStore::page(const std::string& plugin, const std::string& page,
                                              const PropertyTable& table)
{
    const fs::path file = folder_.empty() ? fs::path() : folder_ / (plugin + ".json");
    return std::make_shared<StoredSettings>(*this, file, page, table);
}

}  // namespace jet::host
