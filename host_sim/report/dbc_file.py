"""DBC files for any nodes, derived from octet.dbc.

Each node has its own messages: `N3_SENSES` for node 3, with signals such as `N3_SENSES_feel`, so that the signals of
several messages and robots stay distinct in tools that list them by name alone. Start values and the parameters of
the end-to-end protection are added to the contents of octet.dbc.
"""

from collections import OrderedDict
from collections.abc import Iterable, Sequence
from copy import deepcopy
from typing import Any

import cantools
from cantools.database.can import Database, Message
from cantools.database.can.formats.dbc.dbc_attribute import DbcAttribute
from cantools.database.can.formats.dbc.dbc_attribute_definition import DbcAttributeDefinition
from cantools.database.can.formats.dbc.dbc_specifics import DbcSpecifics
from cantools.database.can.node import Node
from cantools.database.utils import sort_signals_by_start_bit

from host_sim.protocol.codec import DBC, Protocol

CRC, COUNTER = "crc", "counter"
"""The signals of the end-to-end protection."""


def _number(name: str, maximum: int, kind: str = "BO_") -> DbcAttributeDefinition[Any]:
    return DbcAttributeDefinition(name, default_value=0, kind=kind, type_name="INT", minimum=0, maximum=maximum)


def _word(name: str, words: Sequence[str]) -> DbcAttributeDefinition[Any]:
    return DbcAttributeDefinition(name, default_value=words[0], kind="BO_", type_name="ENUM", choices=list(words))


_E2E = {
    it.name: it
    for it in (
        _word("E2EProfile", ["none", "PROFILE_01"]),
        _word("E2EDataIDMode", ["E2E_P01_DATAID_BOTH"]),
        _number("E2EDataID", 0x7FF),
        _number("E2EDataLength", 64),
        _number("E2ECRCOffset", 63),
        _number("E2ECounterOffset", 63),
    )
}
"""Attributes named as in AUTOSAR's E2E profile 1; lengths and offsets are in bits."""


def dbc_text(nodes: Iterable[int]) -> str:
    """The text of a DBC file for nodes."""
    return database(nodes).as_dbc_string(sort_signals=sort_signals_by_start_bit)


def database(nodes: Iterable[int]) -> Database:
    """The messages of nodes, as a database of cantools."""
    octet = cantools.database.load_file(DBC)
    assert isinstance(octet, Database)
    assert octet.dbc is not None
    (body, robot) = octet.nodes
    numbers = list(nodes)
    messages = [_of_node(message, node, robot.name) for node in numbers for message in octet.messages]
    robots = [Node(_sender(robot.name, node), robot.comment) for node in numbers]
    specifics = deepcopy(octet.dbc)
    specifics.attribute_definitions.update(_E2E)
    return Database(messages, [body, *robots], octet.buses, octet.version, specifics)


def _of_node(original: Message, node: int, robot: str) -> Message:
    """A copy of a message with the identifier and the names of a node."""
    message = deepcopy(original)
    message.frame_id = Protocol(node).id_of(original.name)
    message.name = f"N{node}_{original.name}"
    message.senders[:] = [_sender(it, node) if it == robot else it for it in original.senders]
    for signal in message.signals:
        signal.receivers = [_sender(it, node) if it == robot else it for it in signal.receivers]
        signal.raw_initial = int(max(signal.minimum or 0, 0))
        signal.name = f"{message.name}_{signal.name}"
        if signal.multiplexer_signal is not None:
            signal.multiplexer_signal = f"{message.name}_{signal.multiplexer_signal}"
    message.dbc = _with_protection(original, message.frame_id)
    message.refresh()
    return message


def _sender(name: str, node: int) -> str:
    return f"{name}_{node}"


def _with_protection(original: Message, data_id: int) -> DbcSpecifics:
    """The attributes of a message, including those of its end-to-end protection if it has one."""
    attributes = OrderedDict(original.dbc.attributes if original.dbc else {})
    places = {signal.name: signal.start for signal in original.signals}
    if CRC in places:
        values = {
            "E2EProfile": 1,
            "E2EDataIDMode": 0,
            "E2EDataID": data_id,
            "E2EDataLength": 8 * original.length,
            "E2ECRCOffset": places[CRC],
            "E2ECounterOffset": places.get(COUNTER, 0),
        }
        attributes.update({name: DbcAttribute(value, _E2E[name]) for name, value in values.items()})
    return DbcSpecifics(attributes=attributes)
