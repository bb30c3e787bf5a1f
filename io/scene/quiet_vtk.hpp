// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <string>

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
    void DisplayErrorText(const char* text) override;

    const std::string& first() const { return first_; }

private:
    std::string first_;
};

/// Has VTK's errors kept, and neither printed nor logged, as long as it lives: what users are told is our sentence.
class QuietVtk
{
public:
    QuietVtk();
    ~QuietVtk();
    QuietVtk(const QuietVtk&) = delete;
    QuietVtk& operator=(const QuietVtk&) = delete;

    /// The first error without the place in VTK's source that it begins with; empty where there was none.
    std::string sentence() const;

private:
    vtkNew<VtkErrors> errors_;
    vtkSmartPointer<vtkOutputWindow> window_;
    vtkLogger::Verbosity verbosity_;
};

} // namespace talus
