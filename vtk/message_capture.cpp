#include "vtk/message_capture.h"

#include "files/printable.h"
#include "visorder/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <mutex>
#include <new>
#include <stdexcept>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace visorder::detail {

namespace {

/// What VTK said, without where in VTK: "ERROR: In FILE, line N\nvtkClass (0x1234): text\n\n" gives "text".
std::string one_line(std::string text)
{
    if (const auto in_file = text.find(": In "), line_end = text.find('\n');
        in_file != std::string::npos && line_end != std::string::npos && in_file < line_end)
        text.erase(0, line_end + 1);
    if (const auto address = text.find(" (0x"), colon = text.find("): ");
        text.starts_with("vtk") && address != std::string::npos && colon != std::string::npos)
        text.erase(0, colon + 3);
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.erase(text.find_last_not_of(' ') + 1);
    return printable(text);
}

class CollectingWindow : public vtkOutputWindow {
public:
    static CollectingWindow* New();
    vtkTypeMacro(CollectingWindow, vtkOutputWindow)

        void DisplayText(const char*) override
    {
    }
    void DisplayDebugText(const char*) override {}
    void DisplayErrorText(const char* text) override { add(errors, text); }
    void DisplayGenericWarningText(const char* text) override { add(errors, text); }
    void DisplayWarningText(const char* text) override { add(warnings, text); }

    std::vector<std::string> errors;
    std::vector<std::string> warnings;

private:
    void add(std::vector<std::string>& to, const char* text)
    {
        const std::lock_guard lock(mutex_);
        to.push_back(one_line(text));
    }

    std::mutex mutex_; // readers may report from several threads
};

vtkStandardNewMacro(CollectingWindow);

/// Puts a window in the place of VTK's for as long as it lives, and keeps the log off the terminal.
class WindowScope {
public:
    explicit WindowScope(CollectingWindow* window)
        : window_(vtkOutputWindow::GetInstance()), verbosity_(vtkLogger::GetCurrentVerbosityCutoff())
    {
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
        vtkOutputWindow::SetInstance(window);
    }
    ~WindowScope()
    {
        vtkOutputWindow::SetInstance(window_);
        vtkLogger::SetStderrVerbosity(verbosity_);
    }
    WindowScope(const WindowScope&) = delete;
    WindowScope& operator=(const WindowScope&) = delete;

private:
    vtkSmartPointer<vtkOutputWindow> window_;
    vtkLogger::Verbosity verbosity_;
};

/// The first error that tells more than that there was one.
std::string most_telling(const std::vector<std::string>& errors)
{
    const auto found = std::find_if(errors.begin(), errors.end(),
                                    [](const std::string& error) { return !error.starts_with("Algorithm vtk"); });
    return found == errors.end() ? "VTK cannot make a data set of it" : *found;
}

} // namespace

std::vector<std::string> run_reader(const std::filesystem::path& file, const std::function<void()>& read)
{
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);

    const vtkNew<CollectingWindow> window;
    std::string thrown;
    {
        const WindowScope scope(window);
        try {
            read();
        } catch (const std::bad_alloc&) {
            thrown = "it asks for more memory than there is";
        } catch (const std::length_error&) {
            thrown = "it asks for more memory than there is";
        }
    }
    if (!window->errors.empty())
        throw InputError(fmt::format("{}: cannot be read: {}", file.string(), most_telling(window->errors)));
    if (!thrown.empty())
        throw InputError(fmt::format("{}: cannot be read: {}", file.string(), thrown));
    return window->warnings;
}

} // namespace visorder::detail
