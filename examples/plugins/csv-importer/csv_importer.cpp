// CSV importer: each row of a table becomes a rectangle. The first row names the columns; x, y, width and height are
// needed, name and color are used where they are. Separators are ',' or ';', whichever the first row has; fields may be
// quoted (RFC 4180). Errors name line and column; what cannot be kept is a note.
#include <jet/format.hpp>
#include <jet/plugin.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

struct Field {
    std::string text;
    int column = 1;  ///< where it begins in its line
};

/// Splits the text into rows of fields. Quoted fields may hold separators, doubled quotes and line ends.
class Table {
public:
    Table(std::string_view text, std::string file) : text_(text), file_(std::move(file))
    {
        if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);  // byte order mark
        const std::string_view first = text_.substr(0, text_.find('\n'));
        separator_ =
            std::count(first.begin(), first.end(), ';') > std::count(first.begin(), first.end(), ',') ? ';' : ',';
    }

    bool atEnd() const { return at_ >= text_.size(); }
    double done() const { return text_.empty() ? 1 : static_cast<double>(at_) / static_cast<double>(text_.size()); }
    /// Of the row that row() read last.
    jet::Location where(int column = 0) const { return {file_, rowLine_, column}; }

    jet::Result<std::vector<Field>> row()
    {
        rowLine_ = line_;
        std::vector<Field> fields;
        do {
            auto field = readField();
            if (!field) return field.error();
            fields.push_back(std::move(*field));
        } while (take(separator_));
        take('\r');
        if (!atEnd() && !take('\n'))
            return jet::Error("After a quoted field there must be a separator or the end of the line.",
                              {file_, line_, column()});
        return fields;
    }

private:
    int column() const { return static_cast<int>(at_ - lineStart_) + 1; }

    bool take(char c)
    {
        if (atEnd() || text_[at_] != c) return false;
        ++at_;
        if (c == '\n') ++line_, lineStart_ = at_;
        return true;
    }

    jet::Result<Field> readField()
    {
        Field field{{}, column()};
        if (!take('"')) {
            while (!atEnd() && text_[at_] != separator_ && text_[at_] != '\n' && text_[at_] != '\r')
                field.text += text_[at_++];
            return field;
        }
        const jet::Location start{file_, line_, field.column};
        while (!atEnd()) {
            if (take('"')) {
                if (!take('"')) return field;
                field.text += '"';
            } else if (take('\n')) {
                field.text += '\n';
            } else {
                field.text += text_[at_++];
            }
        }
        return jet::Error("This quoted field has no end.", start);
    }

    std::string_view text_;
    std::string file_;
    char separator_ = ',';
    std::size_t at_ = 0, lineStart_ = 0;
    int line_ = 1, rowLine_ = 1;
};

std::string trimmed(std::string_view text)
{
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return std::string(text);
}

class Reader {
public:
    explicit Reader(jet::ImportRequest& request)
        : request_(request),
          table_({reinterpret_cast<const char*>(request.data.data()), request.data.size()}, request.file.string())
    {
    }

    jet::Result<void> read()
    {
        if (auto header = readHeader(); !header) return header;
        while (!table_.atEnd()) {
            const auto row = table_.row();
            if (!row) return row.error();
            if (row->size() == 1 && trimmed(row->front().text).empty()) continue;  // an empty line
            if (auto added = addBox(*row); !added) return added;
            if (++rows_ % 256 == 0 && !request_.progress(table_.done()))
                return jet::Error("The import was cancelled.", table_.where());
        }
        return {};
    }

private:
    jet::Result<void> readHeader()
    {
        if (table_.atEnd())
            return jet::Error("The table is empty; its first row must name the columns.", table_.where());
        const auto row = table_.row();
        if (!row) return row.error();
        for (const Field& field : *row) columns_.push_back(trimmed(field.text));
        for (const char* needed : {"x", "y", "width", "height"})
            if (!column(needed))
                return jet::Error("The first row names no column '" + std::string(needed) +
                                      "'; x, y, width and height are needed.",
                                  table_.where());
        for (const std::string& name : columns_)
            if (name != "x" && name != "y" && name != "width" && name != "height" && name != "name" && name != "color")
                request_.notes.push_back({"The column '" + name + "' is not used.", table_.where()});
        return {};
    }

    std::optional<std::size_t> column(std::string_view name) const
    {
        const auto found = std::find(columns_.begin(), columns_.end(), name);
        if (found == columns_.end()) return std::nullopt;
        return static_cast<std::size_t>(found - columns_.begin());
    }

    const Field* field(const std::vector<Field>& row, std::string_view name) const
    {
        const auto index = column(name);
        return index && *index < row.size() ? &row[*index] : nullptr;
    }

    jet::Result<double> number(const std::vector<Field>& row, std::string_view name) const
    {
        const Field* found = field(row, name);
        if (!found)
            return jet::Error("This row has no " + std::string(name) + "; it has too few fields.", table_.where());
        const std::string text = trimmed(found->text);
        std::string_view rest(text);
        double value = 0;
        if (!jet::readNumber(rest, value) || !rest.empty())
            return jet::Error("'" + text + "' is not a number, but the column is '" + std::string(name) + "'.",
                              table_.where(found->column));
        return value;
    }

    jet::Result<void> addBox(const std::vector<Field>& row)
    {
        double values[4];
        for (int i = 0; i < 4; ++i) {
            static constexpr const char* kNames[] = {"x", "y", "width", "height"};
            const auto value = number(row, kNames[i]);
            if (!value) return value.error();
            values[i] = *value;
        }
        const jet::Vec2 corner(values[0], values[1]), size(values[2], values[3]);
        const jet::Item& shape = request_.edit.add<jet::ShapeItem>(
            request_.parent, jet::Path::rectangle({corner, jet::Vec2(corner + size)}));
        if (const Field* name = field(row, "name"); name && !trimmed(name->text).empty())
            request_.edit.set(shape, "name", trimmed(name->text));
        if (const Field* color = field(row, "color"); color && !trimmed(color->text).empty()) paint(shape, *color);
        return {};
    }

    /// A colour needs the effect of another plugin, which may be absent: then it is left out, with one note.
    void paint(const jet::Item& shape, const Field& text)
    {
        const auto color = jet::Color::parse(trimmed(text.text));
        if (!color) return request_.notes.push_back({color.error().message, table_.where(text.column)});
        try {
            request_.edit.addEffect(shape, "polygon-face", {{"color", *color}});
        } catch (const jet::Failure& failure) {
            if (!colorless_)
                request_.notes.push_back({std::string("Colours are left out: ") + failure.what(), table_.where()});
            colorless_ = true;
        }
    }

    jet::ImportRequest& request_;
    Table table_;
    std::vector<std::string> columns_;
    std::size_t rows_ = 0;
    bool colorless_ = false;
};

class CsvImporter final : public jet::Importer {
public:
    jet::Result<void> read(jet::ImportRequest& request) override { return Reader(request).read(); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.importer<CsvImporter>("csv"); }
