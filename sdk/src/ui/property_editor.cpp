#include <jet/ui/property_editor.hpp>

#include "color_edit.hpp"
#include "number_edit.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include <cmath>
#include <limits>

namespace jet::ui {

namespace {

QString translated(const char* text) { return QCoreApplication::translate("PropertyEditor", text); }

/// Makes `child` all there is in `parent`.
void fillWith(QWidget* parent, QWidget* child)
{
    auto* layout = new QHBoxLayout(parent);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(child);
    parent->setFocusProxy(child);
}

class FlagEditor final : public PropertyEditor {
public:
    explicit FlagEditor(QWidget* parent) : PropertyEditor(parent), box_(new QCheckBox(this))
    {
        fillWith(this, box_);
        connect(box_, &QCheckBox::clicked, this, [this](bool on) {
            box_->setTristate(false);
            report(on, EditPhase::Done);
        });
    }

    void show(const std::optional<Value>& value) override
    {
        box_->setTristate(!value);
        box_->setCheckState(!value ? Qt::PartiallyChecked : value->as<bool>() ? Qt::Checked : Qt::Unchecked);
    }

private:
    QCheckBox* box_;
};

class NumberEditor final : public PropertyEditor {
public:
    NumberEditor(const PropertySpec& spec, QWidget* parent)
        : PropertyEditor(parent), whole_(spec.kind == ValueKind::Integer), edit_(new NumberEdit(spec, this))
    {
        fillWith(this, edit_);
        edit_->setHandler([this](double number, bool done) {
            const EditPhase phase = done ? EditPhase::Done : EditPhase::Ongoing;
            report(whole_ ? Value(static_cast<std::int64_t>(number)) : Value(number), phase);
        });
    }

    void show(const std::optional<Value>& value) override
    {
        edit_->setNumber(value ? std::optional(value->as<double>()) : std::nullopt);
    }

private:
    bool whole_;
    NumberEdit* edit_;
};

class VectorEditor final : public PropertyEditor {
public:
    VectorEditor(const PropertySpec& spec, QWidget* parent)
        : PropertyEditor(parent), x_(new NumberEdit(spec, this)), y_(new NumberEdit(spec, this))
    {
        auto* layout = new QHBoxLayout(this);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setSpacing(4);
        layout->addWidget(x_, 1);
        layout->addWidget(y_, 1);
        setFocusProxy(x_);
        const auto changed = [this](double, bool done) {
            const auto x = x_->number(), y = y_->number();
            if (!apart_ && (!x || !y)) return;  // wait for the other one
            report(Vec2(x.value_or(kMixed), y.value_or(kMixed)), done ? EditPhase::Done : EditPhase::Ongoing);
        };
        x_->setHandler(changed);
        y_->setHandler(changed);
    }

    void show(const std::optional<Value>& value) override
    {
        const Vec2 v = value ? value->as<Vec2>() : Vec2(kMixed, kMixed);
        apart_ = value && v.hasNaN();
        const auto shown = [](double part) { return std::isnan(part) ? std::nullopt : std::optional(part); };
        x_->setNumber(shown(v.x()));
        y_->setNumber(shown(v.y()));
    }

private:
    static constexpr double kMixed = std::numeric_limits<double>::quiet_NaN();
    NumberEdit *x_, *y_;
    bool apart_ = false;  // each part by itself
};

class ColorEditor final : public PropertyEditor {
public:
    explicit ColorEditor(QWidget* parent) : PropertyEditor(parent), edit_(new ColorEdit(this))
    {
        fillWith(this, edit_);
        edit_->setHandler(
            [this](Color color, bool done) { report(color, done ? EditPhase::Done : EditPhase::Ongoing); });
    }

    void show(const std::optional<Value>& value) override
    {
        edit_->setColor(value ? std::optional(value->as<Color>()) : std::nullopt);
    }

private:
    ColorEdit* edit_;
};

class TextEditor final : public PropertyEditor {
public:
    explicit TextEditor(QWidget* parent) : PropertyEditor(parent), edit_(new QLineEdit(this))
    {
        fillWith(this, edit_);
        edit_->setPlaceholderText(translated("several values"));
        connect(edit_, &QLineEdit::editingFinished, this, [this] {
            if (!edit_->isModified()) return;
            edit_->setModified(false);
            report(edit_->text().toStdString(), EditPhase::Done);
        });
    }

    void show(const std::optional<Value>& value) override
    {
        const QString text = value ? QString::fromStdString(value->as<std::string>()) : QString();
        edit_->setPlaceholderText(value ? QString() : translated("several values"));
        if (text != edit_->text()) edit_->setText(text);
        edit_->setModified(false);
    }

private:
    QLineEdit* edit_;
};

/// A button that opens the text in a dialog: blocks of text do not fit a row.
class BlockEditor final : public PropertyEditor {
public:
    BlockEditor(const PropertySpec& spec, QWidget* parent)
        : PropertyEditor(parent), title_(QString::fromStdString(spec.label)), button_(new QPushButton(this))
    {
        fillWith(this, button_);
        connect(button_, &QPushButton::clicked, this, [this] { edit(); });
    }

    void show(const std::optional<Value>& value) override
    {
        text_ = value ? QString::fromStdString(value->as<std::string>()) : QString();
        if (!value) return button_->setText(translated("Edit… (several values)"));
        const int lines = text_.isEmpty() ? 0 : static_cast<int>(text_.count(QLatin1Char('\n'))) + 1;
        button_->setText(QCoreApplication::translate("PropertyEditor", "Edit… (%n line(s))", nullptr, lines));
    }

private:
    void edit()
    {
        QDialog dialog(window());
        dialog.setWindowTitle(title_);
        dialog.resize(640, 480);
        auto* text = new QPlainTextEdit(text_, &dialog);
        text->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
        auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, &dialog);
        auto* layout = new QVBoxLayout(&dialog);
        layout->addWidget(text);
        layout->addWidget(buttons);
        connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
        connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
        if (dialog.exec() != QDialog::Accepted || text->toPlainText() == text_) return;
        report(text->toPlainText().toStdString(), EditPhase::Done);
    }

    QString title_, text_;
    QPushButton* button_;
};

class ChoiceEditor final : public PropertyEditor {
public:
    ChoiceEditor(const PropertySpec& spec, QWidget* parent) : PropertyEditor(parent), box_(new QComboBox(this))
    {
        fillWith(this, box_);
        for (const std::string& choice : spec.choices) add(QString::fromStdString(choice));
        box_->setPlaceholderText(translated("several values"));
        box_->setFocusPolicy(Qt::StrongFocus);
        connect(box_, &QComboBox::activated, this,
                [this](int index) { report(box_->itemData(index).toString().toStdString(), EditPhase::Done); });
    }

    void show(const std::optional<Value>& value) override
    {
        const QString id = value ? QString::fromStdString(value->as<std::string>()) : QString();
        // What is stored may be a choice of a plugin that is not here: it stays, until another is chosen.
        if (value && box_->findData(id) < 0) add(id);
        box_->setCurrentIndex(value ? box_->findData(id) : -1);
    }

private:
    void add(const QString& id)
    {
        box_->addItem(id.isEmpty() ? translated("automatic")
                                   : QCoreApplication::translate("Properties", id.toUtf8().constData()),
                      id);
    }

    QComboBox* box_;
};

/// For kinds that are edited elsewhere (paths in the scene) or not understood (the plugin is absent).
class ReadOnlyEditor final : public PropertyEditor {
public:
    explicit ReadOnlyEditor(QWidget* parent) : PropertyEditor(parent), label_(new QLabel(this))
    {
        fillWith(this, label_);
        label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
        label_->setTextFormat(Qt::PlainText);
    }

    void show(const std::optional<Value>& value) override
    {
        constexpr int kLongest = 40;
        const QString text = value ? QString::fromStdString(value->text()) : QString();
        label_->setText(text.size() > kLongest ? text.left(kLongest) + QChar(0x2026) : text);
        label_->setToolTip(text.left(2000));
        if (!value) label_->setText(translated("(several values)"));
    }

private:
    QLabel* label_;
};

}  // namespace

PropertyEditor::PropertyEditor(QWidget* parent) : QWidget(parent) {}
PropertyEditor::~PropertyEditor() = default;

void PropertyEditor::report(const Value& value, EditPhase phase) const
{
    // The handler may rebuild the form and with it this editor: call a copy.
    if (const Handler handler = handler_) handler(value, phase);
}

PropertyEditor* createPropertyEditor(const PropertySpec& spec, QWidget* parent)
{
    switch (spec.kind) {
    case ValueKind::Bool: return new FlagEditor(parent);
    case ValueKind::Integer:
    case ValueKind::Real: return new NumberEditor(spec, parent);
    case ValueKind::Vec2: return new VectorEditor(spec, parent);
    case ValueKind::Color: return new ColorEditor(parent);
    case ValueKind::Text:
        if (spec.multiline) return new BlockEditor(spec, parent);
        return new TextEditor(parent);
    case ValueKind::Choice: return new ChoiceEditor(spec, parent);
    default: return new ReadOnlyEditor(parent);
    }
}

}  // namespace jet::ui
