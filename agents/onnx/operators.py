"""The operators that a network may use: deterministic ones without code, files or subgraphs.

Convolutions, loops, conditions and random numbers are not among them.
"""

from typing import Final

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
