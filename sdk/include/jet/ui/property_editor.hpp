// Property editors: a widget for each kind of declared property, as the Inspector and the tool options use them.
//
//   auto* editor = jet::ui::createPropertyEditor(spec, parent);
//   editor->setHandler([&](const jet::Value& value, jet::ui::EditPhase phase) { ... });
//   editor->show(value);                                // does not call the handler
#pragma once

#include <jet/property.hpp>

#include <QWidget>

#include <functional>
#include <optional>
#include <span>

namespace jet::ui {

/// A value that is still being changed (spinning, picking a colour) is Ongoing; merge those into one undo step.
enum class EditPhase { Ongoing, Done };

/// Edits one property. [GUI thread]
class JET_API PropertyEditor : public QWidget {
public:
    using Handler = std::function<void(const Value& value, EditPhase phase)>;

    explicit PropertyEditor(QWidget* parent);
    ~PropertyEditor() override;

    /// Shows a value. None: several values that differ; the editor is blank until the user enters one for all. A vector
    /// may have NaN where only that part differs: its parts are then entered one by one, and what is reported has NaN
    /// in the part that shall stay as it is.
    virtual void show(const std::optional<Value>& value) = 0;
    /// Called for each change the user makes.
    void setHandler(Handler handler) { handler_ = std::move(handler); }

protected:
    void report(const Value& value, EditPhase phase) const;

private:
    Handler handler_;
};

/// The editor for a property of this kind; paths, item references and unknown kinds are shown, not edited. Owned by
/// `parent`.
JET_API PropertyEditor* createPropertyEditor(const PropertySpec& spec, QWidget* parent);

/// A form with a labelled editor for each property of a table. [GUI thread]
class JET_API PropertyForm : public QWidget {
public:
    using Handler = std::function<void(const PropertySpec& spec, const Value& value, EditPhase phase)>;
    /// The value to show; none: mixed.
    using Source = std::function<std::optional<Value>(const PropertySpec& spec)>;
    enum class Layout { Rows, Line };  ///< a column of rows, or side by side as in a tool bar

    PropertyForm(std::span<const PropertySpec> specs, Layout layout, QWidget* parent);
    PropertyForm(const PropertyTable& table, Layout layout, QWidget* parent)
        : PropertyForm(table.specs(), layout, parent)
    {
    }
    ~PropertyForm() override;

    void setHandler(Handler handler);
    void show(const Source& source);

private:
    struct Private;
    std::unique_ptr<Private> d_;
};

}  // namespace jet::ui
