"""The limits of a network: its size, the versions of its format, the operators that it may use.

The operators are deterministic, and without code, files or subgraphs: convolutions, loops,
conditions and random numbers are not among them.
"""

from typing import Final

LARGEST: Final = 16 * 2**20
"""Largest file [bytes]."""

OPSETS: Final = range(13, 22)
"""Versions of ONNX's operators that are allowed: the oldest onnxruntime of the extra has all."""

IR_VERSIONS: Final = range(7, 11)
"""Versions of the file format that are allowed."""

MOST_NODES: Final = 2000
"""Most operators of a network."""

MOST_OBSERVATION: Final = 64
"""Most numbers of an observation; those of colift's own tasks have 5 to 11."""

MOST_STATE: Final = 65_536
"""Most numbers in a network's state."""

OWN_DOMAINS: Final = ("", "ai.onnx")
"""Names of ONNX's own operators."""

LARGEST_TENSOR: Final = 2**18
"""Most numbers in a tensor that is computed: 2 MiB."""

LARGEST_SUM: Final = 2**22
"""Most numbers in all tensors of a step: 32 MiB."""

_NAMES: Final = """
Abs Add And ArgMax ArgMin BatchNormalization Cast Ceil Celu Clip Concat Constant ConstantOfShape
Cos CumSum Div Elu Equal Erf Exp Expand Flatten Floor GRU Gather Gelu Gemm Greater
GreaterOrEqual HardSigmoid HardSwish Identity LSTM LayerNormalization LeakyRelu Less LessOrEqual
Log LogSoftmax MatMul Max Mean Min Mish Mul Neg Not Or PRelu Pow RNN Reciprocal ReduceMax
ReduceMean ReduceMin ReduceProd ReduceSum ReduceSumSquare Relu Reshape Round Selu Shape Sigmoid
Sign Sin Slice Softmax Softplus Softsign Split Sqrt Squeeze Sub Sum Tan Tanh ThresholdedRelu
Tile Transpose Unsqueeze Where
"""

OPERATORS: Final = frozenset(_NAMES.split())
"""Names of the operators, all of ONNX's own domain."""

RECURRENT: Final = frozenset({"GRU", "LSTM", "RNN"})
"""Operators whose inner tensors are larger than their outputs."""
