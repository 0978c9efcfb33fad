"""The wire format of every message and service: MD5 sums as Gazebo Classic 11 / gazebo_ros_pkgs 2.9 compute them."""

import os

import pytest
from gazebo_msgs import msg, srv

FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EMPTY = "d41d8cd98f00b204e9800998ecf8427e"
RESULT = "2ec6f3eff0161f4257b808b12bc830c2"  # bool success, string status_message

MESSAGES = {
    "ContactState": "48c0ffb054b8c444f870cecea1ee50d9",
    "ContactsState": "acbcb1601a8e525bf72509f18e6f668d",
    "LinkState": "0818ebbf28ce3a08d48ab1eaa7309ebe",
    "LinkStates": "48c080191eb15c41858319b4d8a609c2",
    "ModelState": "9330fd35f2fcd82d457e54bd54e10593",
    "ModelStates": "48c080191eb15c41858319b4d8a609c2",
    "ODEJointProperties": "1b744c32a920af979f53afe2f9c3511f",
    "ODEPhysics": "667d56ddbd547918c32d1934503dc335",
    "PerformanceMetrics": "884f71fd5037b886ec5e126b83c4425a",
    "SensorPerformanceMetric": "01762ded18cfe9ebc7c8222667c99547",
    "WorldState": "de1a9de3ab7ba97ac0e9ec01a4eb481e",
}
SERVICES = {  # name: (service, request, response)
    "ApplyBodyWrench": ("585b9f9618aa0581b207e2f2d90866bc", "e37e6adf97eba5095baa77dffb71e5bd", RESULT),
    "ApplyJointEffort": ("c0039811b8cc919490b3cff748cdf46b", "2c3396ab9af67a509ecd2167a8fe41a2", RESULT),
    "BodyRequest": ("5eade9afe7f232d78005bd0cafeab755", "5eade9afe7f232d78005bd0cafeab755", EMPTY),
    "DeleteLight": ("ae11ea8100d536d5b92c2b5917abf912", "4fb676dfb4741fc866365702a859441c", RESULT),
    "DeleteModel": ("9ce56b4e9e54616de25d796dc972a262", "ea31c8eab6fc401383cf528a7c0984ba", RESULT),
    "GetJointProperties": ("7b30be900f50aa21efec4a0ec92d91c9", "0be1351618e1dc030eb7959d9a4902de", "cd7b30a39faa372283dc94c5f6457f82"),
    "GetLightProperties": ("df2cef87e13e2e6990e81e8aaa454c19", "4fb676dfb4741fc866365702a859441c", "9a19ddd5aab4c13b7643d1722c709f1f"),
    "GetLinkProperties": ("0e06a70386d0ee3fb880c02f23fcd821", "7d82d60381f1b66a30f2157f60884345", "a8619f92d17cfcc3958c0fd13299443d"),
    "GetLinkState": ("09d6c98cce97b35f7ab9bd70300657ab", "7551675c30aaa71f7c288d4864552001", "8ba55ad34f9c072e75c0de57b089753b"),
    "GetModelProperties": ("5717f7bd34ed990fa80e28b3015027a3", "ea31c8eab6fc401383cf528a7c0984ba", "b7f370938ef77b464b95f1bab3ec5028"),
    "GetModelState": ("4c515e936d3319c9610c559c60bfc3d4", "19d412713cefe4a67437e17a951e759e", "ccd51739bb00f0141629e87b792e92b9"),
    "GetPhysicsProperties": ("575a5e74786981b7df2e3afc567693a6", EMPTY, "575a5e74786981b7df2e3afc567693a6"),
    "GetWorldProperties": ("36bb0f2eccf4d8be971410c22818ba3f", EMPTY, "36bb0f2eccf4d8be971410c22818ba3f"),
    "JointRequest": ("0be1351618e1dc030eb7959d9a4902de", "0be1351618e1dc030eb7959d9a4902de", EMPTY),
    "SetJointProperties": ("15a76e921b1410c698d82782ea5fa370", "331fd8f35fd27e3c1421175590258e26", RESULT),
    "SetJointTrajectory": ("88f5c10979e3f9649d5ae87a3b12aa65", "649dd2eba5ffd358069238825f9f85ab", RESULT),
    "SetLightProperties": ("e6f13430c57278bb364aca53a1bf5ebf", "10d953f2306aec18460eb80dd94fdd47", RESULT),
    "SetLinkProperties": ("d534ce1b36ee99de0ffa806c3a6348f0", "68ac74a4be01b165bc305b5ccdc45e91", RESULT),
    "SetLinkState": ("8a5146eb66ae4d26b0860b08f3f271be", "22a2c757d56911b6f27868159e9a872d", RESULT),
    "SetModelConfiguration": ("10e3139d3b669c40afc057d38956fff7", "160eae60f51fabff255480c70afa289f", RESULT),
    "SetModelState": ("5b3ab0281d4f5445def017e3a2e4a07b", "cb042b0e91880f4661b29ea5b6234350", RESULT),
    "SetPhysicsProperties": ("97e2057080558ce4730434b5fae75c91", "abd9f82732b52b92e9d6bb36e6a82452", RESULT),
    "SpawnModel": ("9ed9c82c96abe1a00c3e8cdaeee24413", "6d0eba5753761cd57e6263a056b79930", RESULT),
}


@pytest.mark.parametrize("name", MESSAGES)
def test_message(name):
    assert getattr(msg, name)._md5sum == MESSAGES[name]


@pytest.mark.parametrize("name", SERVICES)
def test_service(name):
    service = getattr(srv, name)
    sums = (service._md5sum, service._request_class._md5sum, service._response_class._md5sum)
    assert sums == SERVICES[name]


@pytest.mark.parametrize("folder, table", [("msg", MESSAGES), ("srv", SERVICES)])
def test_nothing_is_missing_or_untested(folder, table):
    files = {name[:-4] for name in os.listdir(os.path.join(FOLDER, folder))}
    assert files == set(table)
