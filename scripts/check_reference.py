#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that the reference manual has all that is public, and nothing else.

  scripts/check_reference.py XML PACKAGE_DESCRIPTION...

XML is the folder that doxygen writes with EXTRACT_ALL: what is documented, and what is not. Then

- each class, function, type and constant of include/CGAL has documentation, and so has each public member; that
  of a model may stand with the concept;
- each of them is in a group, and in a list of a PACKAGE_DESCRIPTION, and these name nothing else;
- no markup is left in the text, as by quotes that a line ends in;
- a class that is a model of a concept is in the list of models of that concept, and the other way round.

What is below internal/ and in no group, or in a namespace internal, is not public.
"""

import glob
import os
import re
import sys
import xml.etree.ElementTree

NAMESPACES = ("CGAL", "CGAL::Mixed_meshes_3", "CGAL::Mixed_meshes_3::IO")


def text_of(entity, *tags):
    return "".join("".join(part.itertext()) for tag in tags for part in entity.findall(tag)).strip()


def prose_of(paragraph):
    """The text, without that of programs."""
    yield paragraph.text or ""
    for part in paragraph:
        if part.tag not in ("programlisting", "verbatim", "computeroutput"):
            yield from prose_of(part)
        yield part.tail or ""


def is_documented(entity):
    return text_of(entity, "briefdescription", "detaileddescription") != ""


class Reference:
    """The entities of doxygen's XML."""

    def __init__(self, folder):
        self.classes, self.members, self.namespace_members = {}, {}, []
        self.grouped, self.models, self.models_of, self.stray_markup = set(), {}, {}, []
        compounds = [
            compound
            for path in sorted(glob.glob(os.path.join(folder, "*.xml")))
            for compound in xml.etree.ElementTree.parse(path).getroot().findall("compounddef")
        ]
        for compound in compounds:
            for paragraph in compound.iter("para"):
                prose = "".join(prose_of(paragraph))
                found = re.search(r"(@section|\\ref |</?(tt|b|em|p)>).{,60}", prose, re.DOTALL)
                if found:
                    self.stray_markup.append(f"{compound.findtext('compoundname')}: {found.group()!r}")
            kind, name = compound.get("kind"), compound.findtext("compoundname")
            if kind == "group":
                self.grouped.update(inner.text for inner in compound.findall("innerclass"))
            if kind in ("class", "struct", "concept") and compound.get("prot") != "private":
                self.add_class(name, compound)
            elif kind in ("namespace", "group"):
                for member in compound.iter("memberdef"):
                    if kind == "group":
                        self.grouped.add(member.findtext("qualifiedname"))
                    self.namespace_members.append(member)

    def add_class(self, name, compound):
        if "internal" in name or "@" in name:
            return
        self.classes[name] = compound
        self.members[name] = [m for m in compound.iter("memberdef") if m.get("prot") == "public"]
        for paragraph in compound.iter("simplesect"):
            title = text_of(paragraph, "title").lower()
            names = re.findall(r"[\w:]+", text_of(paragraph, "para"))
            if title == "has models":
                self.models[name] = {n for n in names if n.startswith("CGAL::")}
            elif title in ("is model of", "refines"):
                self.models_of.setdefault(name, set()).update(names)

    def concepts_of(self, name):
        """Those that a class is a model of, those that they refine included."""
        found, to_do = set(), list(self.models_of.get(name, ()))
        while to_do:
            concept = to_do.pop()
            if concept not in found:
                found.add(concept)
                to_do += self.models_of.get(concept, ())
        return found

    def names_in_concepts(self, name):
        names = {
            m.findtext("name") for concept in self.concepts_of(name) for m in self.members.get(concept, ())
        }
        # Nested types such as `Cell`, whose members are in the concept's nested type.
        outer, _, inner = name.rpartition("::")
        for concept in self.concepts_of(outer):
            names.update(m.findtext("name") for m in self.members.get(f"{concept}::{inner}", ()))
        return names

    def undocumented(self):
        for name, compound in self.classes.items():
            inherited = self.names_in_concepts(name)
            if not is_documented(compound):
                yield name
            for member in self.members[name]:
                if member.get("kind") != "friend":
                    if member.findtext("name") not in inherited and not is_documented(member):
                        yield f"{name}::{member.findtext('name')}"
                    yield from self.undocumented_values(member)
        for member in self.public_namespace_members():
            if not is_documented(member):
                yield member.findtext("qualifiedname")
            yield from self.undocumented_values(member)

    @staticmethod
    def undocumented_values(member):
        for value in member.findall("enumvalue"):
            if not is_documented(value):
                yield f"{member.findtext('qualifiedname')}::{value.findtext('name')}"

    def public_namespace_members(self):
        for member in self.namespace_members:
            scope = member.findtext("qualifiedname").rpartition("::")[0]
            if scope in NAMESPACES and self.is_public(member, member.findtext("qualifiedname")):
                yield member

    def is_public(self, entity, name):
        """What a file below internal/ has is public if it is in a group."""
        return "/internal/" not in entity.find("location").get("file") or name in self.grouped

    def public_names(self):
        """Of namespaces: classes, functions, types and constants."""
        names = {m.findtext("qualifiedname") for m in self.public_namespace_members()}
        for name, compound in self.classes.items():
            scope = name.rpartition("::")[0]
            if scope in NAMESPACES and self.is_public(compound, name):
                names.add(name)
        # Operators are found by those who need no list.
        return {name for name in names if "::operator" not in name}

    def asymmetric_models(self):
        for name in self.classes:
            for concept in self.concepts_of(name):
                is_model = name.startswith("CGAL::") # else it is a concept that refines this one
                if is_model and concept in self.classes and name not in self.models.get(concept, ()):
                    yield f"{concept}: {name} is missing in the list of models"
        for concept, models in self.models.items():
            for name in models:
                if name in self.classes and concept not in self.concepts_of(name):
                    yield f"{name}: not said to be a model of {concept}"


def listed_names(descriptions):
    """Names in the lists, with the places where they are."""
    for description in descriptions:
        with open(description, encoding="utf-8") as lines:
            for number, line in enumerate(lines, 1):
                for name in re.findall(r"^- `([\w:]+)(?:\(\))?`$", line.rstrip()):
                    yield name, f"{description}:{number}"


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    reference = Reference(sys.argv[1])
    public = reference.public_names()
    listed = dict(listed_names(sys.argv[2:]))
    defects = [f"{name}: not documented" for name in reference.undocumented()]
    defects += [f"{name}: in no list of a PackageDescription.txt" for name in sorted(public - set(listed))]
    defects += [f"{name}: in no group" for name in sorted(public - reference.grouped)]
    defects += [
        f"{place}: {name} is not public"
        for name, place in listed.items()
        if name not in public and name not in reference.classes
    ]
    defects += sorted(reference.asymmetric_models())
    defects += [f"{place}: markup that is not understood" for place in sorted(set(reference.stray_markup))]
    for defect in defects:
        print(defect)
    number = sum(len(members) for members in reference.members.values())
    print(f"{len(public)} public names and {number} members, {len(defects)} defects")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
