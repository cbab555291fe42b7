// Words of the page in English and German, and numbers with units.

const german: Record<string, string> = {
  "Open": "Öffnen",
  "Open a file": "Datei öffnen",
  "or drop it here": "oder hier ablegen",
  "Nothing is uploaded":
    "Nichts wird hochgeladen: Die Datei bleibt auf diesem Gerät, und diese Seite darf sich mit " +
    "keinem Server verbinden.",
  "Fit": "Alles zeigen",
  "Zoom in": "Vergrößern",
  "Zoom out": "Verkleinern",
  "Undo": "Rückgängig",
  "Redo": "Wiederholen",
  "Edit": "Bearbeiten",
  "Name": "Name",
  "Delete": "Löschen",
  "Add a station": "Station hinzufügen",
  "Reverse": "Umkehren",
  "Make one-way": "In eine Richtung",
  "Make two-way": "In beide Richtungen",
  "Node": "Knoten",
  "Path": "Pfad",
  "Click places for nodes; Escape ends.": "Orte für Knoten anklicken; Escape beendet.",
  "Click from node to node, or places between; Enter ends the path, Escape drops it.":
    "Von Knoten zu Knoten klicken, oder Orte dazwischen; Enter beendet den Pfad, Escape verwirft " +
    "ihn.",
  "editing": "wird bearbeitet",
  "Measure": "Messen",
  "Layout": "Layout",
  "Find": "Suchen",
  "Findings": "Befunde",
  "Export": "Export",
  "View": "Ansicht",
  "Level": "Ebene",
  "all levels": "alle Ebenen",
  "Color by": "Farbe nach",
  "nothing": "nichts",
  "Shading": "Darstellung",
  "colors": "Farben",
  "density": "Dichte",
  "Arrows": "Pfeile",
  "Nodes": "Knoten",
  "Stations": "Stationen",
  "Labels": "Namen",
  "Grid": "Gitter",
  "Scale bar": "Maßstab",
  "Legend": "Legende",
  "Dark": "Dunkel",
  "Palette": "Palette",
  "Floor plan": "Grundriss",
  "Add a floor plan": "Grundriss hinzufügen",
  "Pixels per meter": "Pixel je Meter",
  "Rotation in degrees": "Drehung in Grad",
  "Left edge in meters": "Linker Rand in Metern",
  "Lower edge in meters": "Unterer Rand in Metern",
  "Swept areas": "Überstrichene Flächen",
  "Length x width of the vehicle in meters, such as 2x1.2":
    "Länge x Breite des Fahrzeugs in Metern, etwa 2x1.2",
  "paths": "Pfade",
  "nodes": "Knoten",
  "stations": "Stationen",
  "length": "Länge",
  "size": "Größe",
  "vehicle types": "Fahrzeugtypen",
  "refused": "abgelehnt",
  "Name or condition, such as maxSpeed > 1": "Name oder Bedingung, etwa maxSpeed > 1",
  "found": "gefunden",
  "Route": "Route",
  "from": "von",
  "to": "nach",
  "Show": "Zeigen",
  "Remove": "Entfernen",
  "Compare with": "Vergleichen mit",
  "no difference": "kein Unterschied",
  "Picture": "Bild",
  "File": "Datei",
  "Check": "Prüfen",
  "errors": "Fehler",
  "warnings": "Warnungen",
  "no findings": "keine Befunde",
  "reading": "wird gelesen",
  "checking": "wird geprüft",
  "Cancel": "Abbrechen",
  "Close": "Schließen",
  "The engine stopped": "Das Programm ist stehen geblieben",
  "Not enough memory, or a fault of this page. Open a smaller file, or use the command.":
    "Zu wenig Speicher, oder ein Fehler dieser Seite. Öffnen Sie eine kleinere Datei, oder " +
    "nehmen Sie den Befehl.",
  "not in the file": "nicht in der Datei",
  "Click points to measure; Escape ends.": "Punkte anklicken zum Messen; Escape beendet.",
  "is larger than this page can hold": "ist größer, als diese Seite fassen kann",
  "Use the command `guideway`": "Nehmen Sie den Befehl `guideway`",
  "Map of the layout. Arrow keys move, plus and minus zoom, 0 shows all.":
    "Karte des Layouts. Pfeiltasten bewegen, Plus und Minus zoomen, 0 zeigt alles.",
};

/** Texts that are too long to be their own keys. */
const english: Record<string, string> = {
  "Nothing is uploaded":
    "Nothing is uploaded: the file stays on this device, and this page may not connect to any " +
    "server.",
};

// A server that renders pages may load this, too, and has no navigator.
export const language = globalThis.navigator?.language?.startsWith("de") ? "de" : "en";

/** A text of the page in the language of the browser. */
export function t(text: string): string {
  return (language === "de" ? german : english)[text] ?? text;
}

export function count(value: number): string {
  return value.toLocaleString(language);
}

export function meters(value: number): string {
  const unit = Math.abs(value) >= 1000 ? ["km", 1000] : ["m", 1];
  const digits = { maximumFractionDigits: 2 };
  return `${(value / (unit[1] as number)).toLocaleString(language, digits)} ${unit[0]}`;
}
