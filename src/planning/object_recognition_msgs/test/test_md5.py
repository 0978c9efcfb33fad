"""The types must be those that compiled tools of Noetic speak: same MD5 sums."""

from object_recognition_msgs import msg, srv

MESSAGES = {
    "ObjectInformation": "921ec39f51c7b927902059cf3300ecde",
    "ObjectRecognitionAction": "7d8979a0cf97e5078553ee3efee047d2",
    "ObjectType": "ac757ec5be1998b0167e7efcda79e3cf",
    "RecognizedObject": "f92c4cb29ba11f26c5f7219de97e900d",
    "RecognizedObjectArray": "bad6b1546b9ebcabb49fb3b858d78964",
    "Table": "39efebc7d51e44bd2d72f2df6c7823a2",
    "TableArray": "d1c853e5acd0ed273eb6682dc01ab428",
}
SERVICES = {"GetObjectInformation": "dd7d344324fd86c32836f4fe1bc7b322"}


def test_sums():
    assert {name: getattr(msg, name)._md5sum for name in MESSAGES} == MESSAGES
    assert {name: getattr(srv, name)._md5sum for name in SERVICES} == SERVICES
