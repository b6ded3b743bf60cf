#!/usr/bin/env python3
"""Checks that includes go one way. Usage: check_rooms.py SOURCE_DIR BUILD_DIR/rooms.txt

A line of rooms.txt is `room|sub-rooms, lowest first|public headers|libraries`, as genio_room()
writes it. Complaints, one a line, each with its file:
- a sub-room includes a higher one, or a file of a folder that is no sub-room;
- a sub-room declares a class of a higher one, which is an include in hiding;
- a room includes another that its target does not link, or a header that is not public;
- a public header includes one of its room that is not (it could not be installed alone);
- a folder holds more than 22 sources;
- a header is not implemented by the file of its name.
"""
import collections
import pathlib
import re
import sys

FULL = 22  # sources in a folder


def read_rooms(path):
    rooms = {}
    for line in pathlib.Path(path).read_text().splitlines():
        name, subs, headers, links = (part.split() for part in line.split("|"))
        rooms[name[0]] = {
            "subs": subs,
            "public": {f"{name[0]}/{h}.hpp" for h in headers},
            "links": {l.removeprefix("genio_").removeprefix("genio::") for l in links},
        }
    return rooms


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if m := re.match(r'#include "([^"]+)"', line):
            yield number, m.group(1)


CLASS = re.compile(r"(?:class|struct) (\w+)(?: final)?( :(?!:)| \{|;)")


def classes(path, declared):
    """Names of the classes at the margin that a file only declares, or that it defines."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if (m := CLASS.match(line)) and (m.group(2) == ";") == declared:
            yield number, m.group(1)


def homes(room):
    """The sub-room folders in which each class of a room is defined."""
    result = collections.defaultdict(set)
    for path in room.rglob("*.hpp"):
        for _, name in classes(path, declared=False):
            result[name].add(path.parent.relative_to(room).as_posix())
    return result


def reachable(rooms, name):
    seen, todo = {name}, [name]
    while todo:
        for link in rooms[todo.pop()]["links"] & rooms.keys():
            if link not in seen:
                seen.add(link)
                todo.append(link)
    return seen


def check(source, rooms):
    complaints, folders = [], collections.Counter()
    for name, room in rooms.items():
        linked = reachable(rooms, name)
        order = {sub: i for i, sub in enumerate(room["subs"])}
        home = homes(source / name) if room["subs"] else {}
        for path in sorted((source / name).rglob("*.[ch]pp")):
            file = path.relative_to(source).as_posix()
            folders[path.parent.relative_to(source).as_posix()] += 1
            sub = path.parent.relative_to(source / name).as_posix()
            if room["subs"] and sub not in order:
                complaints.append(f"{file}: '{sub}' is no sub-room of {name}")
                continue
            header = path.with_suffix(".hpp")
            for number, declared in classes(path, declared=True) if home else ():
                above = [h for h in home[declared] if order.get(h, 99) > order[sub]]
                if above and len(above) == len(home[declared]):
                    complaints.append(f"{file}:{number}: declares {declared} of '{above[0]}',"
                                      f" which stands above '{sub}'")
            for number, target in includes(path):
                other = target.split("/")[0]
                if other not in rooms:
                    continue
                where = f"{file}:{number}: includes {target}"
                if other != name:
                    if other not in linked:
                        complaints.append(f"{where}, but {name} does not link {other}")
                    elif target not in rooms[other]["public"]:
                        complaints.append(f"{where}, which is no public header of {other}")
                    continue
                if file in room["public"] and target not in room["public"]:
                    complaints.append(f"{where}, which is not public as the file itself is")
                to = pathlib.PurePosixPath(target).parent.relative_to(name).as_posix()
                if room["subs"] and order.get(to, 99) > order[sub]:
                    complaints.append(f"{where}: '{to}' stands above '{sub}'")
            if path.suffix == ".cpp" and not header.exists() and path.stem != "main":
                complaints.append(f"{file}: has no header of its name")
        for header in room["public"]:
            if not (source / header).exists():
                complaints.append(f"{header}: is listed as public and does not exist")
    for folder, count in sorted(folders.items()):
        if count > FULL:
            complaints.append(f"{folder}: holds {count} sources; expected at most {FULL}")
    return complaints


def main():
    rooms = read_rooms(sys.argv[2])
    complaints = check(pathlib.Path(sys.argv[1]), rooms)
    print("\n".join(complaints))
    print(f"{len(rooms)} rooms, {len(complaints)} complaints")
    return 1 if complaints else 0


sys.exit(main())
