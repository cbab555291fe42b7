; Installer of Guideway for Windows, for one user: it needs no rights of an administrator.
; `cargo xtask dist --windows` runs makensis with VERSION, STAGE (the folder of the files)
; and a compressor.
; Exit codes: 0 done, 1 canceled, 2 not possible now, which the message explains.
Unicode true
Target amd64-unicode
!include MUI2.nsh
!include LogicLib.nsh
!include StrFunc.nsh
!include WinMessages.nsh
; These make the functions.
${StrRep}
${UnStrRep}

!define UNINSTALL "Software\Microsoft\Windows\CurrentVersion\Uninstall\Guideway"
!define CLASSES "Software\Classes"
!define WINDOW "guideway-window.exe"
!define ABILITIES "Software\Guideway\Capabilities"

Name "Guideway"
OutFile "${OUTPUT}"
InstallDir "$LOCALAPPDATA\Programs\Guideway"
InstallDirRegKey HKCU "${UNINSTALL}" "InstallLocation"
RequestExecutionLevel user
ManifestDPIAware true
ManifestLongPathAware true
BrandingText "Guideway ${VERSION}"
VIProductVersion "${VERSION}.0"
VIAddVersionKey "ProductName" "Guideway"
VIAddVersionKey "ProductVersion" "${VERSION}"
VIAddVersionKey "FileVersion" "${VERSION}"
VIAddVersionKey "FileDescription" "Guideway installer"
VIAddVersionKey "LegalCopyright" "MIT OR Apache-2.0"

!define MUI_ICON "${ICON}"
!define MUI_UNICON "${ICON}"
!define MUI_FINISHPAGE_RUN "$INSTDIR\${WINDOW}"
!insertmacro MUI_PAGE_LICENSE "${STAGE}/LICENSE-MIT.txt"
!insertmacro MUI_PAGE_COMPONENTS
!insertmacro MUI_PAGE_DIRECTORY
!insertmacro MUI_PAGE_INSTFILES
!insertmacro MUI_PAGE_FINISH
!insertmacro MUI_UNPAGE_CONFIRM
!insertmacro MUI_UNPAGE_INSTFILES
!insertmacro MUI_LANGUAGE "English"
!insertmacro MUI_LANGUAGE "German"

LangString PROGRAMS ${LANG_ENGLISH} "Programs"
LangString PROGRAMS ${LANG_GERMAN} "Programme"
LangString MENU ${LANG_ENGLISH} "Start menu"
LangString MENU ${LANG_GERMAN} "Startmenü"
LangString FILES ${LANG_ENGLISH} "Open layouts by double click"
LangString FILES ${LANG_GERMAN} "Layouts durch Doppelklick öffnen"
LangString TERMINAL ${LANG_ENGLISH} "guideway in every terminal (PATH)"
LangString TERMINAL ${LANG_GERMAN} "guideway in jedem Terminal (PATH)"
LangString LAYOUT ${LANG_ENGLISH} "Layout of automated guided vehicles (LIF)"
LangString LAYOUT ${LANG_GERMAN} "Layout fahrerloser Transportfahrzeuge (LIF)"
LangString RUNNING ${LANG_ENGLISH} "A file in $INSTDIR is in use or cannot be written. \
    Close the windows of Guideway and start again."
LangString RUNNING ${LANG_GERMAN} "Eine Datei in $INSTDIR ist in Benutzung oder nicht \
    beschreibbar. Schließen Sie die Fenster von Guideway und beginnen Sie noch einmal."
LangString LONG_PATH ${LANG_ENGLISH} "The variable PATH is too long to be changed here. \
    Add this folder to it in the settings of Windows: $INSTDIR"
LangString LONG_PATH ${LANG_GERMAN} "Die Variable PATH ist zu lang, um sie hier zu ändern. \
    Fügen Sie in den Einstellungen von Windows diesen Ordner hinzu: $INSTDIR"

; Ends with exit code 2 when a program cannot be replaced, before anything has changed.
!macro CHECK_UNUSED PROGRAM
    ${If} ${FileExists} "$INSTDIR\${PROGRAM}"
        ClearErrors
        FileOpen $0 "$INSTDIR\${PROGRAM}" a
        ${If} ${Errors}
            MessageBox MB_OK|MB_ICONSTOP "$(RUNNING)" /SD IDOK
            SetErrorLevel 2
            Quit
        ${EndIf}
        FileClose $0
    ${EndIf}
!macroend

; $0: PATH of the user. $1: whether it is whole; this program cuts texts at 1,024 letters.
!macro READ_PATH
    StrCpy $0 ""
    StrCpy $1 0
    ; Text that is not expanded; without a buffer the call returns the bytes that it needs.
    System::Call 'advapi32::RegGetValueW(p 0x80000001, w "Environment", w "Path", \
        i 0x10000006, p 0, p 0, *i 0 r2) i .r3'
    ${If} $3 = 2
        StrCpy $1 1
    ${ElseIf} $3 = 0
    ${AndIf} $2 < 1400
        ReadRegStr $0 HKCU "Environment" "Path"
        StrCpy $1 1
    ${EndIf}
!macroend

; Writes $0 as PATH of the user, and tells programs that run.
!macro WRITE_PATH
    WriteRegExpandStr HKCU "Environment" "Path" "$0"
    SendMessage ${HWND_BROADCAST} ${WM_SETTINGCHANGE} 0 "STR:Environment" /TIMEOUT=5000
!macroend

; Tells Explorer that file types have changed.
!macro TELL_EXPLORER
    System::Call 'shell32::SHChangeNotify(i 0x08000000, i 0, p 0, p 0)'
!macroend

Section "$(PROGRAMS)" SECTION_PROGRAMS
    SectionIn RO
    !insertmacro CHECK_UNUSED guideway.exe
    !insertmacro CHECK_UNUSED ${WINDOW}
    SetOutPath "$INSTDIR"
    File /r "${STAGE}/*.*"
    WriteUninstaller "$INSTDIR\uninstall.exe"
    WriteRegStr HKCU "${UNINSTALL}" "DisplayName" "Guideway"
    WriteRegStr HKCU "${UNINSTALL}" "DisplayVersion" "${VERSION}"
    WriteRegStr HKCU "${UNINSTALL}" "DisplayIcon" "$INSTDIR\${WINDOW}"
    WriteRegStr HKCU "${UNINSTALL}" "Publisher" "Guideway developers"
    WriteRegStr HKCU "${UNINSTALL}" "URLInfoAbout" "https://github.com/guideway/guideway"
    WriteRegStr HKCU "${UNINSTALL}" "InstallLocation" "$INSTDIR"
    WriteRegStr HKCU "${UNINSTALL}" "UninstallString" '"$INSTDIR\uninstall.exe"'
    WriteRegStr HKCU "${UNINSTALL}" "QuietUninstallString" '"$INSTDIR\uninstall.exe" /S'
    WriteRegDWORD HKCU "${UNINSTALL}" "NoModify" 1
    WriteRegDWORD HKCU "${UNINSTALL}" "NoRepair" 1
    SectionGetSize ${SECTION_PROGRAMS} $0
    WriteRegDWORD HKCU "${UNINSTALL}" "EstimatedSize" $0
SectionEnd

Section "$(MENU)"
    CreateShortcut "$SMPROGRAMS\Guideway.lnk" "$INSTDIR\${WINDOW}"
SectionEnd

; Makes Guideway one of the programs that Explorer offers for an extension.
!macro OFFER EXTENSION
    WriteRegStr HKCU "${CLASSES}\${EXTENSION}\OpenWithProgids" "Guideway.Layout" ""
    WriteRegStr HKCU "${ABILITIES}\FileAssociations" "${EXTENSION}" "Guideway.Layout"
    WriteRegStr HKCU "${CLASSES}\Applications\${WINDOW}\SupportedTypes" "${EXTENSION}" ""
!macroend

Section "$(FILES)"
    WriteRegStr HKCU "${CLASSES}\Guideway.Layout" "" "$(LAYOUT)"
    WriteRegStr HKCU "${CLASSES}\Guideway.Layout\DefaultIcon" "" "$INSTDIR\${WINDOW},0"
    WriteRegStr HKCU "${CLASSES}\Guideway.Layout\shell\open\command" "" \
        '"$INSTDIR\${WINDOW}" "%1"'
    WriteRegStr HKCU "${CLASSES}\Applications\${WINDOW}" "FriendlyAppName" "Guideway"
    WriteRegStr HKCU "${CLASSES}\Applications\${WINDOW}\shell\open\command" "" \
        '"$INSTDIR\${WINDOW}" "%1"'
    WriteRegStr HKCU "${ABILITIES}" "ApplicationName" "Guideway"
    WriteRegStr HKCU "${ABILITIES}" "ApplicationDescription" "$(LAYOUT)"
    WriteRegStr HKCU "Software\RegisteredApplications" "Guideway" "${ABILITIES}"
    ; No other program reads this one. `.lif.json` is `.json` for Windows.
    WriteRegStr HKCU "${CLASSES}\.lif" "" "Guideway.Layout"
    !insertmacro OFFER .lif
    !insertmacro OFFER .json
    !insertmacro OFFER .geojson
    !insertmacro OFFER .dxf
    !insertmacro OFFER .arrow
    !insertmacro OFFER .feather
    !insertmacro OFFER .xodr
    !insertmacro OFFER .osm
    !insertmacro TELL_EXPLORER
SectionEnd

Section "$(TERMINAL)"
    !insertmacro READ_PATH
    ${If} $1 = 0
        MessageBox MB_OK|MB_ICONINFORMATION "$(LONG_PATH)" /SD IDOK
    ${Else}
        ${StrRep} $2 ";$0;" ";$INSTDIR;" ""
        ${If} $2 == ";$0;"
            ${If} $0 == ""
                StrCpy $0 "$INSTDIR"
            ${Else}
                StrCpy $0 "$0;$INSTDIR"
            ${EndIf}
            !insertmacro WRITE_PATH
        ${EndIf}
    ${EndIf}
SectionEnd

!macro WITHDRAW EXTENSION
    DeleteRegValue HKCU "${CLASSES}\${EXTENSION}\OpenWithProgids" "Guideway.Layout"
    DeleteRegKey /ifempty HKCU "${CLASSES}\${EXTENSION}\OpenWithProgids"
    DeleteRegKey /ifempty HKCU "${CLASSES}\${EXTENSION}"
!macroend

Section "Uninstall"
    !insertmacro CHECK_UNUSED guideway.exe
    !insertmacro CHECK_UNUSED ${WINDOW}
    !insertmacro READ_PATH
    ${If} $1 = 1
    ${AndIf} $0 != ""
        ${UnStrRep} $2 ";$0;" ";$INSTDIR;" ";"
        ${If} $2 != ";$0;"
            ; Without the two semicolons around it.
            StrCpy $0 $2 -1 1
            ${If} $0 == ""
                DeleteRegValue HKCU "Environment" "Path"
            ${Else}
                !insertmacro WRITE_PATH
            ${EndIf}
        ${EndIf}
    ${EndIf}
    ReadRegStr $0 HKCU "${CLASSES}\.lif" ""
    ${If} $0 == "Guideway.Layout"
        DeleteRegValue HKCU "${CLASSES}\.lif" ""
    ${EndIf}
    !insertmacro WITHDRAW .lif
    !insertmacro WITHDRAW .json
    !insertmacro WITHDRAW .geojson
    !insertmacro WITHDRAW .dxf
    !insertmacro WITHDRAW .arrow
    !insertmacro WITHDRAW .feather
    !insertmacro WITHDRAW .xodr
    !insertmacro WITHDRAW .osm
    DeleteRegKey HKCU "${CLASSES}\Guideway.Layout"
    DeleteRegKey HKCU "${CLASSES}\Applications\${WINDOW}"
    DeleteRegValue HKCU "Software\RegisteredApplications" "Guideway"
    DeleteRegKey HKCU "Software\Guideway"
    DeleteRegKey HKCU "${UNINSTALL}"
    !insertmacro TELL_EXPLORER
    Delete "$SMPROGRAMS\Guideway.lnk"
    ; The files that the installer wrote, and no other: the folder may have been chosen by hand.
    !include "${REMOVALS}"
    Delete "$INSTDIR\uninstall.exe"
    RMDir "$INSTDIR"
SectionEnd
