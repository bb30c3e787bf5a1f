// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/quiet_vtk.hpp"

#include "io/text/sentence.hpp"

#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <string_view>

namespace talus
{

/// Keeps the first of VTK's errors instead of printing it.
class VtkErrors : public vtkOutputWindow
{
public:
    static VtkErrors* New();
    vtkTypeMacro(VtkErrors, vtkOutputWindow);

    void DisplayText(const char*) override {}
    void DisplayWarningText(const char*) override {}
    void DisplayErrorText(const char* text) override
    {
        if (first.empty()) first = text;
    }

    std::string first;
};
vtkStandardNewMacro(VtkErrors);

QuietVtk::QuietVtk()
    : errors_(vtkSmartPointer<VtkErrors>::New()), window_(vtkOutputWindow::GetInstance()),
      verbosity_(vtkLogger::GetCurrentVerbosityCutoff())
{
    vtkOutputWindow::SetInstance(errors_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

QuietVtk::~QuietVtk()
{
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(window_);
}

std::string QuietVtk::sentence() const
{
    constexpr std::string_view end_of_place = "): ";
    const std::string& first = errors_->first;
    const std::size_t place = first.find(end_of_place);
    std::string text = one_line(first.substr(place == std::string::npos ? 0 : place + end_of_place.size()));
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

} // namespace talus
