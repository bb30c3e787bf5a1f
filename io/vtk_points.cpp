// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtk_points.hpp"

#include "io/input_error.hpp"
#include "io/input_file.hpp"
#include "io/toml_value.hpp"
#include "io/trial_run.hpp"

#include <vtkErrorCode.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fmt/format.h>

#include <exception>
#include <string>

namespace talus
{

namespace
{

/// Keeps the first of VTK's errors instead of printing them.
class ErrorCollector : public vtkOutputWindow
{
public:
    static ErrorCollector* New();
    vtkTypeMacro(ErrorCollector, vtkOutputWindow);

    void DisplayText(const char*) override {}
    void DisplayWarningText(const char*) override {}
    void DisplayErrorText(const char* text) override
    {
        if (first_.empty()) first_ = text;
    }

    /// The first error without the place in VTK's source that it begins with; empty where there was none.
    std::string sentence() const
    {
        constexpr std::string_view end_of_place = "): ";
        const std::size_t place = first_.find(end_of_place);
        std::string text = one_line(first_.substr(place == std::string::npos ? 0 : place + end_of_place.size()));
        text.erase(text.find_last_not_of(' ') + 1);
        return text;
    }

private:
    std::string first_;
};

vtkStandardNewMacro(ErrorCollector);

/// Has VTK's errors collected, and not logged, as long as it lives.
class QuietVtk
{
public:
    QuietVtk() : window_(vtkOutputWindow::GetInstance()), verbosity_(vtkLogger::GetCurrentVerbosityCutoff())
    {
        vtkOutputWindow::SetInstance(errors);
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    }
    ~QuietVtk()
    {
        vtkLogger::SetStderrVerbosity(verbosity_);
        vtkOutputWindow::SetInstance(window_);
    }
    QuietVtk(const QuietVtk&) = delete;
    QuietVtk& operator=(const QuietVtk&) = delete;

    vtkNew<ErrorCollector> errors;

private:
    vtkSmartPointer<vtkOutputWindow> window_;
    vtkLogger::Verbosity verbosity_;
};

template <class Reader> vtkSmartPointer<vtkPointSet> read_with(const std::filesystem::path& path)
{
    const QuietVtk quiet;
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    try {
        reader->Update();
    } catch (const std::exception&) { // lists longer than there can be, or than there is memory for
        throw InputError(fmt::format("{}: VTK cannot read it: its sizes are too large to be true", path.string()));
    }
    const std::string error = quiet.errors->sentence();
    if (!error.empty()) throw InputError(fmt::format("{}: VTK cannot read it: {}", path.string(), error));
    if (reader->GetErrorCode() != vtkErrorCode::NoError)
        throw InputError(fmt::format(
            "{}: VTK cannot read it: {}", path.string(), vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode())));
    return reader->GetOutput();
}

vtkSmartPointer<vtkPointSet> read_unprotected(const std::filesystem::path& path)
{
    return path.extension() == ".vtp" ? read_with<vtkXMLPolyDataReader>(path)
                                      : read_with<vtkXMLUnstructuredGridReader>(path);
}

/// What VTK may use to read a file of this size. Compressed files grow at most a thousandfold, and that is far.
TrialLimits limits_for(std::uintmax_t size)
{
    return {.seconds = 10 + static_cast<int>(size >> 20), .memory = (std::size_t{256} << 20) + 32 * size};
}

} // namespace

vtkSmartPointer<vtkPointSet> read_points(const std::filesystem::path& path)
{
    require_file(path, "a VTK file");
    // A damaged file may crash VTK's reader, or have it ask for more memory than there is.
    try_in_a_copy([&] { read_unprotected(path); }, limits_for(std::filesystem::file_size(path)),
        fmt::format("{}: VTK cannot read it: the file is damaged, or holds more than its size allows", path.string()));
    return read_unprotected(path);
}

} // namespace talus
